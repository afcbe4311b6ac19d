"""The files that a folder of shims links to: see `runtime/shim_folder.py`.

They are not imported as modules of this package. Every Python of the machine may read them, version 2 included.
"""
