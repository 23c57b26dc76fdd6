# Completion for bash: the options that the program's --help lists (a subcommand's, after one), else file names.
# shellcheck disable=SC2034
_hybrid_slam() {
  local cur prev words cword subcommands
  _init_completion || return
  local -a help=("$1")
  [[ $cword -gt 1 && $1 == *slam-eval && ${words[1]} != -* ]] && help+=("${words[1]}")
  if [[ $cur == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("${help[@]}" --help 2>/dev/null | grep -oE '^ +(-[A-Za-z],)?--[a-z-]+' |
      grep -oE -e '--[a-z-]+')" -- "$cur")
    return
  fi
  subcommands=$([[ $cword -eq 1 ]] && "$1" --help 2>/dev/null | sed -n '/^Subcommands:/,$ s/^  \([a-z-]\+\).*/\1/p')
  if [[ -n $subcommands ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$subcommands" -- "$cur")
  else
    _filedir
  fi
} &&
  complete -F _hybrid_slam hybrid-slam hybrid-slam-gui hybrid-slam-live log2rawlog motion-model-learn \
    observation-server simul-floorplan slam-compare slam-eval slam-merge
