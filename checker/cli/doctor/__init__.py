"""Whether everything works where the checker is installed; the command `doctor`."""
