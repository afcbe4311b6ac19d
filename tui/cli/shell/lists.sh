_bot_console_remove() { # NAME ENTRY: removes an entry from a variable that is a list of folders
  eval "set -- \"\$1\" \"\$2\" \":\${$1-}:\""
  while case "$3" in *":$2:"*) true ;; *) false ;; esac; do
    set -- "$1" "$2" "${3%%":$2:"*}:${3#*":$2:"}"
  done
  set -- "$1" "${3#:}"
  eval "$1=\"\${2%:}\""
}
