# Completion of bot-console in bash.
_bot_console_complete() {
  local words line="${COMP_LINE:0:COMP_POINT}" IFS=' '
  read -ra words <<<"$line"
  [[ "$line" == *' ' ]] && words+=('')
  local IFS=$'\n'
  COMPREPLY=($("${BOT_CONSOLE_COMMAND:-bot-console}" complete "${words[@]}" 2>/dev/null))
  [[ ${#COMPREPLY[@]} -eq 0 ]] && compopt -o default
  [[ "${COMPREPLY[0]}" == *= ]] && compopt -o nospace
  return 0
}
complete -F _bot_console_complete bot-console
