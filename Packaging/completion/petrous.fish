# fish completion of petrous; the program says what may stand there (petrous complete). Installed as
# share/fish/vendor_completions.d/petrous.fish.

function __petrous_complete
    set -l words (commandline -opc)
    set -l begun (commandline -ct)
    set -l program $words[1]
    set -e words[1]
    for line in ($program complete $words "$begun" 2>/dev/null </dev/null)
        switch $line
            case \tfiles\t'*'
                __fish_complete_suffix (string replace \tfiles\t '' -- $line)
            case \tfiles
                __fish_complete_path "$begun"
            case \tfolders
                __fish_complete_directories "$begun" ''
            case '*'
                if string match -q -- '-*=*' "$begun"
                    set line (string replace -r '=.*' = -- "$begun")$line
                end
                printf '%s\n' "$line"
        end
    end
end

complete -c petrous -f -a '(__petrous_complete)'
