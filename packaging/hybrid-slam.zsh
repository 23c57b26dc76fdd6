#compdef hybrid-slam hybrid-slam-gui hybrid-slam-live log2rawlog motion-model-learn observation-server simul-floorplan slam-compare slam-eval slam-merge
# Completion for zsh: the options that the program's --help lists (a subcommand's, after one), else file names.

local -a command=(${words[1]}) options subcommands
if [[ ${words[1]:t} == slam-eval ]]; then
  subcommands=(${(f)"$($command --help 2>/dev/null | sed -n '/^Subcommands:/,$ s/^  \([a-z-]\+\)  *\(.*\)/\1:\2/p')"})
  if (( CURRENT == 2 )) && [[ $PREFIX != -* ]]; then
    _describe subcommand subcommands
    return
  fi
  [[ ${words[2]} == -* ]] || command+=(${words[2]})
fi
if [[ $PREFIX == -* ]]; then
  options=(${(f)"$($command --help 2>/dev/null | sed -nE 's/^ +(-[A-Za-z],)?(--[a-z-]+).*/\2/p')"})
  compadd -a options
else
  _files
fi
