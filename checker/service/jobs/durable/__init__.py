"""The engine: queues and recovery by DBOS Transact, and tables of what it cannot know."""
