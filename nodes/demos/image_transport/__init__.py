"""Programs of the package `image_transport`."""
