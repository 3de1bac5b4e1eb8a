# bash completion of petrous. The program says what may stand there (petrous complete); installed as
# share/bash-completion/completions/petrous. Without the package: source this file.

_petrous()
{
  local IFS=$' \t\n' word words=() n raw quote= candidate line
  # bash takes words apart at = and :, as in --library=/home and NAME=FILE.
  for ((n = 1; n <= COMP_CWORD; ++n)); do
    raw=${COMP_WORDS[n]}
    if ((${#words[@]})) && { [[ $raw == [=:]* ]] || [[ ${words[-1]} == *[=:] && -n $raw ]]; }; then
      words[-1]+=$raw
    else
      words+=("$raw")
    fi
  done
  # The part that bash replaces.
  word=${COMP_WORDS[COMP_CWORD]}
  [[ $word == [=:]* ]] && word=${word:1}
  case $word in
  \"* | \'*)
    quote=${word:0:1}
    word=${word:1}
    ;;
  esac
  # Without quotes and backslashes, and never run.
  for n in "${!words[@]}"; do
    raw=${words[n]//\\/}
    raw=${raw//[\"\']/}
    words[n]=${raw/#'~/'/"$HOME/"}
  done
  COMPREPLY=()
  while IFS= read -r line; do
    case $line in
    $'\tfiles'*)
      _petrous_files "$word" "$quote" "${line#$'\tfiles'}"
      ;;
    $'\tfolders')
      _petrous_files "$word" "$quote" /
      ;;
    *)
      candidate=${line%%$'\t'*}
      if [[ -n $quote ]]; then
        [[ $candidate == "$word"* ]] && COMPREPLY+=("$candidate")
      else
        printf -v candidate %q "$candidate"
        [[ $candidate == "$word"* ]] && COMPREPLY+=("$candidate")
      fi
      ;;
    esac
  done < <("${COMP_WORDS[0]/#'~/'/"$HOME/"}" complete "${words[@]}" 2>/dev/null </dev/null)
  # On into a folder.
  [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == */ ]] && compopt -o nospace
}

# Names of files; folders to go on into. The last argument: a tab and the end of their names, or a
# slash for folders alone.
_petrous_files()
{
  local plain=$1 name shown suffix=${3#$'\t'}
  [[ -n $2 ]] || plain=${plain//\\/}
  [[ $plain == '~/'* ]] && plain=$HOME/${plain:2}
  while IFS= read -r name; do
    if [[ -d $name ]]; then
      name+=/
    elif [[ $suffix == / || $name != *"$suffix" ]]; then
      continue
    fi
    [[ $1 == '~/'* ]] && name='~'${name#"$HOME"}
    if [[ -n $2 ]]; then
      COMPREPLY+=("$name")
    else
      printf -v shown %q "$name"
      COMPREPLY+=("${shown/#'\~/'/'~/'}")
    fi
  done < <(compgen -f -- "$plain")
}

complete -F _petrous petrous
