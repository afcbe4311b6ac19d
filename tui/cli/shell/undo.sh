if [ -n "${BOT_CONSOLE_SHIMS-}" ]; then
  _bot_console_remove PYTHONPATH "$BOT_CONSOLE_SHIMS"
  [ -n "$PYTHONPATH" ] || unset PYTHONPATH
  _bot_console_remove PATH @RQT@
  _bot_console_remove PATH @ROS2@
  _bot_console_remove PATH @OWN@
  if [ "${ROS_DISTRO-}" = "${BOT_CONSOLE_SET_ROS_DISTRO--}" ] && [ -z "${AMENT_PREFIX_PATH-}" ]; then
    unset ROS_DISTRO ROS_VERSION ROS_PYTHON_VERSION
  fi
  [ "${BOT_CONSOLE_DISTRO-}" != "${BOT_CONSOLE_SET_DISTRO-}" ] || unset BOT_CONSOLE_DISTRO
  unset BOT_CONSOLE_COMMAND BOT_CONSOLE_SHIMS BOT_CONSOLE_SET_ROS_DISTRO BOT_CONSOLE_SET_DISTRO BOT_CONSOLE_WORKSPACE
  if [ -n "${ZSH_VERSION-}" ]; then
    [[ "${_comps[bot-console]-}" != _bot_console_complete ]] || compdef -d bot-console
    [[ "${_comps[ros2]-}" != _bot_console_complete ]] || compdef -d ros2
  else
    case "$(complete -p bot-console 2>/dev/null)" in *" _bot_console_complete "*) complete -r bot-console ;; esac
    case "$(complete -p ros2 2>/dev/null)" in *" _bot_console_complete "*) complete -r ros2 ;; esac
  fi
  unset -f _bot_console_remove _bot_console_complete
fi
