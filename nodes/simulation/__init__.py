"""A planar robot world on pymunk, without ROS: fixed 10 ms steps, one seeded generator, same seed, same run."""
