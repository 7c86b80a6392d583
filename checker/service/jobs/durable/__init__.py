"""The engine on a database: queues, recovery, and tables of all checks and workers."""
