# SPDX-License-Identifier: Apache-2.0
# bash completion for latsch: verbs, their options, values an option is limited to, files. All of it is asked of the
# program itself (latsch help), so that it is that of the version installed.

_latsch() {
  local cur prev verb help values
  cur=${COMP_WORDS[COMP_CWORD]}
  prev=${COMP_WORDS[COMP_CWORD - 1]}
  verb=${COMP_WORDS[1]}
  if [ "$COMP_CWORD" -eq 1 ] || { [ "$verb" = help ] && [ "$COMP_CWORD" -eq 2 ]; }; then
    values=$("${COMP_WORDS[0]}" help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\+\) .*/\1/p')
    if [ "$verb" = help ] && [ "$COMP_CWORD" -eq 2 ]; then values="$values study"; else values="$values --version --help"; fi
    mapfile -t COMPREPLY < <(compgen -W "$values" -- "$cur")
    return
  fi
  help=$("${COMP_WORDS[0]}" help "$verb" 2>/dev/null) || return
  # "--kind TEXT:{fe_tire,ring_tire}": one of these; what is no such option takes files.
  values=$(sed -n "s/^  \(-[a-z],\)\?$prev [A-Z]*:{\([^}]*\)}.*/\2/p" <<<"$help" | tr ',' ' ')
  if [ -n "$values" ]; then
    mapfile -t COMPREPLY < <(compgen -W "$values" -- "$cur")
  elif [ "${cur:0:1}" = - ]; then
    mapfile -t COMPREPLY < <(compgen -W "$(sed -n 's/^  \(-[a-z],\)\?\(--[a-z-]\+\).*/\2/p' <<<"$help")" -- "$cur")
  fi
} && complete -o default -F _latsch latsch
