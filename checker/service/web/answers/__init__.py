"""Answers: refusals, files of results, and the headers of all of them."""
