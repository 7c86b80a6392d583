"""The sandbox of processes that read untrusted files.

One process starts all others (`launcher_process`). It is started again, with nothing of its
parent's, enters its sandbox (`layers`) before there is anything to read, and forks. So no
process within needs to start a program, and none is allowed to; a fork takes 2 ms, where a new
interpreter takes 50.

Each layer is a module: `namespaces` (bubblewrap where it is installed), `account`, `landlock`
and `seccomp`. A layer that the system does not have is left out, and reported.

The caller opens the files, copies them into the request, and treats the answer as hostile
(`files`): a process within gets no path and leaves no file. The process that checks an upload
is in the same sandbox, with a folder to unpack into; its children are started by the launcher
that started it.
"""
