"""The service on one machine: the web process and its workers."""
