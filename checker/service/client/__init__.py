"""The client of the service: uploads a package, waits, and tells its findings."""
