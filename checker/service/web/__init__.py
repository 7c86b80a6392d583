"""The site: pages, the API, and the upload of packages."""
