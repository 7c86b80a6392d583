"""The web service: its site, jobs, store, processes and client.

::

    browser, submit -> web -> store (uploads, results) <- worker -> child that checks
                        +---> jobs (database) <-----------+

- The web process writes an upload to a file, reads its index in a sandboxed process
(`web.uploads.archive_indexes`), puts it into the store and orders the check.
- DBOS has the queues: each try of a stage is a workflow, and the state of a check follows
  from the rows of its workflows alone (`jobs.durable.tasks`). Workers take tasks
  (`jobs.durable.worker`); what fails for a reason outside of the check is tried again, also by
  others if a worker crashes (`jobs.durable.deaths`).
- Each stage (static rules, then the trial) is a child process in the sandbox, which opens the
  upload and answers with a result; a finished stage is not repeated. The child of the next
  stage is started before it is needed (`jobs.children`).
- A check ends as `done`, `refused` (the upload is at fault), `failed` (the checker could not
  finish) or `cancelled`; `jobs.port` is all that the web process knows of jobs.
- A result is in the store under a key of all that it depends on, so that the same upload shares
  it. The id of a check is random, and is all that opens a report; the database has a digest
  of it (`jobs.durable.receipts`).
- The store is a folder or a bucket of S3 (`store.objects`).
"""
