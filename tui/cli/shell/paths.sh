export BOT_CONSOLE_COMMAND=@COMMAND@
if [ -z "${ROS_DISTRO+x}" ] || [ "$ROS_DISTRO" = "${BOT_CONSOLE_SET_ROS_DISTRO-}" ]; then
  export ROS_DISTRO=@DISTRO@ ROS_VERSION=2 ROS_PYTHON_VERSION=3 BOT_CONSOLE_SET_ROS_DISTRO=@DISTRO@
fi
if [ -n @CHOSEN@ ] && [ "${BOT_CONSOLE_DISTRO-}" != @CHOSEN@ ]; then
  export BOT_CONSOLE_DISTRO=@CHOSEN@ BOT_CONSOLE_SET_DISTRO=@CHOSEN@
fi
case ":$PATH:" in *:@RQT@:*) ;; *) export PATH=@RQT@:"$PATH" ;; esac
command -v ros2 >/dev/null 2>&1 || export PATH="$PATH":@ROS2@
command -v bot-console >/dev/null 2>&1 || export PATH="$PATH":@OWN@
[ -z "${BOT_CONSOLE_SHIMS-}" ] || _bot_console_remove PYTHONPATH "$BOT_CONSOLE_SHIMS"
export BOT_CONSOLE_SHIMS=@SHIMS@
export PYTHONPATH="${PYTHONPATH:+$PYTHONPATH:}$BOT_CONSOLE_SHIMS"
