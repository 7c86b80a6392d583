"""Code that all other packages use: errors, the cache, words, processes and their sandbox."""
