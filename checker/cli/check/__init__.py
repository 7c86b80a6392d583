"""`subt-check check`: its arguments, what it prints and writes, and its fixes."""
