"""What a repository needs to be checked: settings and a commit hook; the command `init`."""
