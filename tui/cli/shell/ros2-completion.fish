test (command -s ros2) = @ROS2@/ros2; and complete -c ros2 -f -a '(__bot_console_complete)'
