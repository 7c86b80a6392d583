"""The rules that there are: pages, options, checklist, profiles, suppressions."""
