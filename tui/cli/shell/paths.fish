set -gx BOT_CONSOLE_COMMAND @COMMAND@
if not set -q ROS_DISTRO; or test "$ROS_DISTRO" = "$BOT_CONSOLE_SET_ROS_DISTRO"
    set -gx ROS_DISTRO @DISTRO@
    set -gx ROS_VERSION 2
    set -gx ROS_PYTHON_VERSION 3
    set -gx BOT_CONSOLE_SET_ROS_DISTRO @DISTRO@
end
if test -n @CHOSEN@; and test "$BOT_CONSOLE_DISTRO" != @CHOSEN@
    set -gx BOT_CONSOLE_DISTRO @CHOSEN@
    set -gx BOT_CONSOLE_SET_DISTRO @CHOSEN@
end
contains -- @RQT@ $PATH; or set -gx PATH @RQT@ $PATH
command -q ros2; or set -gx PATH $PATH @ROS2@
command -q bot-console; or set -gx PATH $PATH @OWN@
set -q PYTHONPATH; or set -gx PYTHONPATH
set -gx --path PYTHONPATH (string split : -- $PYTHONPATH | string match -v -- "$BOT_CONSOLE_SHIMS" | string match -v -- '')
set -gx BOT_CONSOLE_SHIMS @SHIMS@
set -gx --path PYTHONPATH $PYTHONPATH $BOT_CONSOLE_SHIMS
