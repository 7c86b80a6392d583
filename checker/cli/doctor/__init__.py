"""Check of the installation: libraries, the sandbox and the viewer; the command `doctor`."""
