"""launch_testing under pytest: `-p launch_testing.pytest.plugin`."""
