# bash completion for curveskel: verbs, options, names that an option takes, and files. All of them
# are read from the program's own help, so that nothing is said twice.

# The names under the help's heading for an option: `--surgery` takes those under "Surgeries:".
_curveskel_names() {
  awk -v heading="${2%y}" '
    tolower($0) ~ "^" heading "[a-z]*:$" { under = 1; next }
    /^[^ ]/ { under = 0 }
    under && /^  [a-z]/ { print $1 }' <<< "$1"
}

_curveskel() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} help names
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    names=$("$1" --help 2> /dev/null | awk '/^Subcommands:/ { under = 1; next }
      /^[^ ]/ { under = 0 }
      under && NF { print $1 }')
    mapfile -t COMPREPLY < <(compgen -W "$names --help --version" -- "$word")
    return
  fi
  help=$("$1" "${COMP_WORDS[1]}" --help 2> /dev/null)
  if [[ $word == -* ]]; then
    names=$(grep -oE '^  (-[a-z],)?--?[a-z-]+' <<< "$help" | grep -oE -- '--[a-z-]+')
    mapfile -t COMPREPLY < <(compgen -W "$names" -- "$word")
    return
  fi
  if [[ $before == --* ]]; then
    names=$(_curveskel_names "$help" "${before#--}")
    if [ -n "$names" ]; then
      mapfile -t COMPREPLY < <(compgen -W "$names" -- "$word")
      return
    fi
  fi
  mapfile -t COMPREPLY < <(compgen -f -- "$word")
}

complete -o filenames -F _curveskel curveskel
