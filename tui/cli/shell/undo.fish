if set -q BOT_CONSOLE_SHIMS
    set -gx --path PYTHONPATH (string split : -- $PYTHONPATH | string match -v -- "$BOT_CONSOLE_SHIMS")
    test (count $PYTHONPATH) -gt 0; or set -e PYTHONPATH
    set -gx PATH (string match -v -- @RQT@ $PATH | string match -v -- @ROS2@ | string match -v -- @OWN@)
    if set -q BOT_CONSOLE_SET_ROS_DISTRO; and test "$ROS_DISTRO" = "$BOT_CONSOLE_SET_ROS_DISTRO"; and not set -q AMENT_PREFIX_PATH
        set -e ROS_DISTRO ROS_VERSION ROS_PYTHON_VERSION
    end
    test "$BOT_CONSOLE_DISTRO" != "$BOT_CONSOLE_SET_DISTRO"; or set -e BOT_CONSOLE_DISTRO
    set -e BOT_CONSOLE_COMMAND BOT_CONSOLE_SHIMS BOT_CONSOLE_SET_ROS_DISTRO BOT_CONSOLE_SET_DISTRO BOT_CONSOLE_WORKSPACE
    complete -e -c bot-console
    if complete -c ros2 | string match -q '*(__bot_console_complete)*'
        complete -e -c ros2
    end
    functions -e __bot_console_complete
end
