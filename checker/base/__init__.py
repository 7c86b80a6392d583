"""What everything else stands on: errors, the cache, words, processes and their sandbox."""
