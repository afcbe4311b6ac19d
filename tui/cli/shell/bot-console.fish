# Completion of bot-console in fish.
function __bot_console_complete
    set -l program bot-console
    set -q BOT_CONSOLE_COMMAND; and set program $BOT_CONSOLE_COMMAND
    set -l words (commandline -opc) (commandline -ct)
    set -l found ($program complete $words 2>/dev/null)
    if set -q found[1]
        printf '%s\n' $found
    else
        __fish_complete_path (commandline -ct)
    end
end
complete -c bot-console -f -a '(__bot_console_complete)'
