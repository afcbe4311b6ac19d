"""Containers for components, as the package `rclcpp_components` has them."""
