"""Code shared by the nodes of this package: parameters, scans, diagnostics, startup and shutdown."""
