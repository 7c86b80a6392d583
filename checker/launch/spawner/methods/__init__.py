"""The whitelisted methods of Ruby's own classes, one file per class."""
