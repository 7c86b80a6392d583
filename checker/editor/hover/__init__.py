"""What an editor shows of the thing under the pointer, as Markdown."""
