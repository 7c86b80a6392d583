"""The client of the service: uploads a package, waits, and prints its findings."""
