"""The web service: its site, jobs, store, processes and client."""
