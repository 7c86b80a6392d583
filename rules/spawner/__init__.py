"""SPW: launch/spawner.rb."""
