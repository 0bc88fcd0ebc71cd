// brickfall completion and brickfall man: both from the commands as they are defined.
#include "brickfall/scene.h"
#include "brickfall/world.h"
#include "cli/commands.h"
#include "cli/console.h"

namespace brickfall::cli {
namespace {

std::string namesOf(const std::vector<CommandWords>& commands) {
  std::string names;
  for (const CommandWords& command : commands) names += (names.empty() ? "" : " ") + command.name;
  return names;
}

std::string optionsOf(const CommandWords& command) {
  std::string options;
  for (const auto& [name, purpose] : command.options) options += (options.empty() ? "" : " ") + name;
  return options;
}

// Scenes are asked for when they are wanted: files, and what `brickfall scenes` lists.
std::string forBash(const std::vector<CommandWords>& commands) {
  std::string text =
      "# bash completion of brickfall: source it, or put it into /etc/bash_completion.d\n"
      "_brickfall() {\n"
      "  local word=\"${COMP_WORDS[COMP_CWORD]}\" scenes=\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W \"" +
      namesOf(commands) +
      "\" -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case \"${COMP_WORDS[1]}\" in\n";
  for (const CommandWords& command : commands) {
    text += "    " + command.name + ") ";
    if (command.takesScene) text += "scenes=\"$(brickfall scenes 2>/dev/null | cut -d' ' -f1)\"; ";
    text += "COMPREPLY=($(compgen -f -W \"" + optionsOf(command) + " $scenes\" -- \"$word\")) ;;\n";
  }
  return text + "  esac\n}\ncomplete -o filenames -F _brickfall brickfall\n";
}

// A text within single quotes of a shell, and of zsh's own colons.
std::string quoted(const std::string& text, const std::string& escaped) {
  std::string out;
  for (char c : text) {
    if (c == '\'') {
      out += "'\\''";
      continue;
    }
    if (escaped.find(c) != std::string::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string forZsh(const std::vector<CommandWords>& commands) {
  std::string text = "#compdef brickfall\n_brickfall() {\n  local -a commands\n  commands=(\n";
  for (const CommandWords& command : commands)
    text += "    '" + command.name + ":" + quoted(command.purpose, ":") + "'\n";
  text += "  )\n  if (( CURRENT == 2 )); then _describe command commands; return; fi\n  case $words[2] in\n";
  for (const CommandWords& command : commands) {
    text += "    " + command.name + ") ";
    if (command.takesScene) text += "compadd -- ${(f)\"$(brickfall scenes 2>/dev/null | cut -d' ' -f1)\"}; ";
    text += "compadd -- " + optionsOf(command) + "; _files ;;\n";
  }
  return text + "  esac\n}\ncompdef _brickfall brickfall\n";
}

std::string forFish(const std::vector<CommandWords>& commands) {
  std::string text = "complete -c brickfall -n __fish_use_subcommand -f\n";
  for (const CommandWords& command : commands) {
    text += "complete -c brickfall -n __fish_use_subcommand -a " + command.name + " -d '" +
            quoted(command.purpose, "\\") + "'\n";
    for (const auto& [name, purpose] : command.options)
      text += "complete -c brickfall -n '__fish_seen_subcommand_from " + command.name + "' -l " + name.substr(2) +
              " -d '" + quoted(purpose, "\\") + "'\n";
    if (command.takesScene)
      text += "complete -c brickfall -n '__fish_seen_subcommand_from " + command.name +
              "' -a '(brickfall scenes 2>/dev/null | cut -d\" \" -f1)'\n";
  }
  return text;
}

// A line of troff: a dash is a dash, and no line begins with a control character.
std::string troff(const std::string& text) {
  std::string out = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (char c : text) {
    if (c == '-' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

}  // namespace

int completion(const std::string& shell, const std::vector<CommandWords>& commands) {
  std::string text;
  if (shell == "bash") text = forBash(commands);
  if (shell == "zsh") text = forZsh(commands);
  if (shell == "fish") text = forFish(commands);
  if (text.empty()) {
    complainf("completion: found \"{}\", expected one of: bash, zsh, fish{}", printable(shell),
              didYouMean(shell, {"bash", "zsh", "fish"}));
    return kBadInput;
  }
  text.pop_back();
  say(text);
  return kOk;
}

int manPage(const std::vector<CommandWords>& commands) {
  std::string text = std::string(".TH BRICKFALL 1 \"\" \"brickfall ") + versionString() +
                     "\"\n.SH NAME\nbrickfall \\- knocks down brick walls\n.SH SYNOPSIS\n"
                     ".B brickfall\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n"
                     "Simulates rigid bodies, brick walls above all: a scene file goes in, a page to watch, a glTF\n"
                     "file and figures come out. A scene is a file, the name of a shipped scene, or \\- for standard\n"
                     "input.\n.SH COMMANDS\n";
  for (const CommandWords& command : commands) {
    text += ".SS " + troff(command.name) + "\n" + troff(command.purpose) + ".\n";
    for (const auto& [name, purpose] : command.options) text += ".TP\n.B " + troff(name) + "\n" + troff(purpose) + "\n";
  }
  text +=
      ".SH EXIT STATUS\n0 done; 1 internal error; 2 bad arguments or scene; 3 a file cannot be read or written;\n"
      "4 done, but bodies became non\\-finite; 130 interrupted.\n.SH FILES\n"
      "Results go into out/SCENE, unless \\-o says where.";
  say(text);
  return kOk;
}

}  // namespace brickfall::cli
