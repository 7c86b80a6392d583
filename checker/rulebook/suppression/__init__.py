"""Findings that the user has set aside, and the effect of each suppression.

The engine gives a `SuppressionMatcher` each place that a rule reports, before repeats are
joined: message, places and fix are those of what is left. Rules run in three steps
(`checker.engine.review`): all that look at the package; those that need `Suppressions`; those
that need `BaselineUse`.

A comment counts before settings, and both before the baseline. The baseline knows a place by
rule, file, element and words, not by its line, and counts: an entry covers the places that it
had, so that a further one is reported.
"""
