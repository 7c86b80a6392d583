"""`subt-check mcp`: checks, explains and corrects packages for programs that speak MCP."""
