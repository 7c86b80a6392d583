"""The engine: a queue and its recovery by DBOS Transact, and a ledger of what is known."""
