"""Text with places: every fact knows the file, line and column it came from.

- A `SourceText` is the text of one file; a `Span` is a part of it; a `Located[T]` is a value
  with its span. `stated` is false if the file does not spell the value out (a default).
- XML is read twice: lxml builds the tree; expat, which knows the byte of each tag, gives the
  positions; both are joined by document order. Start tags are scanned again for attributes.
- `checker.model` keeps the span of everything that is read. A rule hands a value to
  `finding(…)` and never computes a line.
- Through the spawner: strings of the evaluator remember, piece by piece, the Ruby that wrote
  them (`checker.launch.spawner.literals`). What it emits is a `SourceText` again
  (`checker.source.emitted`), parsed by the same reader: a finding in an emitted plugin points
  at the line of Ruby that holds it.
- Through xacro: the child process states for each element which element of which file it is a
  copy of. The expanded text is a `SourceText` as well (`checker.formats.xacro.expanded`).
- A finding about something missing points at line 1 of the file that should hold it, else at
  the package folder. Paths are relative to the package; a sibling's file starts with `../`.
"""
