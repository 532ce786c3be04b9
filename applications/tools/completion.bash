# Bash completion of the three programs: options, .prm files, and the keys after --set with their choices.
# Load it with: source applications/tools/completion.bash     (an installed mesoslip is found by itself)

# All keys of a program as Section/Key=, from its own --print-parameters; with a .prm also those of the probes and phases named there.
# Of keys with choices also Section/Key=choice.
_mesoslip_keys() {
  { "$1" --print-parameters ${2:+"$2"} 2>/dev/null || "$1" --print-parameters 2>/dev/null; } | awk '
    /^ *# /          { sub(/^ *# /, ""); meaning = meaning " " $0; next }
    /^ *subsection / { sub(/^ *subsection /, ""); path[depth++] = $0; meaning = ""; next }
    /^ *end *$/      { --depth; next }
    /^ *set / {
      sub(/^ *set /, ""); sub(/ *=.*/, "")
      line = ""
      for (i = 0; i < depth; ++i) line = line path[i] "/"
      print line $0 "="
      n = 0
      if (meaning ~ /; true or false$/) n = split("true, false", choices, ", ")
      else if (match(meaning, /; one of [^;]*$/)) n = split(substr(meaning, RSTART + 9), choices, ", ")
      for (i = 1; i <= n; ++i) print line $0 "=" choices[i]
      meaning = ""
    }'
}

# The .prm on the command line, if there is one.
_mesoslip_file() {
  local word
  for word in "${COMP_WORDS[@]}"; do
    case $word in *.prm) [ ! -f "$word" ] || { printf '%s\n' "$word"; return; } ;; esac
  done
}

_mesoslip() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} IFS=$'\n'
  case $before in
    --set)
      # Keys hold blanks: quoted as a whole unless the user has opened a quote.
      local quote=\' plain=${current#[\'\"]}
      [ "$plain" = "$current" ] || quote=
      local wanted='=$'
      case $plain in *=*) wanted='=.' ;; esac
      mapfile -t COMPREPLY < <(_mesoslip_keys "$1" "$(_mesoslip_file)" | grep -- "$wanted" | grep -F -- "$plain" | sed "s|^|$quote|")
      compopt -o nospace +o filenames 2>/dev/null
      return
      ;;
    --output | -o | --draft) mapfile -t COMPREPLY < <(compgen -d -- "$current"); return ;;
  esac
  case $current in
    -*)
      local options
      options=$("$1" --help 2>/dev/null | grep -oE -- '--[a-z-]+' | sort -u)
      mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
      ;;
    *) mapfile -t COMPREPLY < <(compgen -f -X '!*.prm' -- "$current"; compgen -d -- "$current") ;;
  esac
}
complete -o filenames -F _mesoslip rve_homogenization contact_dynamics stress_localization
