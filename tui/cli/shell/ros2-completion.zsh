if [[ "$(command -v ros2)" == @ROS2@/ros2 ]]; then compdef _bot_console_complete ros2; fi
