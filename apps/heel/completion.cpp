// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/arguments.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace heel {
namespace {

using Words = std::vector<std::string>;

std::string joined(const Words& words, const std::string& by = " ") {
  return CLI::detail::join(words, by);
}

/// What a shell may offer for an option or an argument.
struct Offer {
  Words names;  ///< "--help", "-h"; of an argument its name in the help, "SCENE".
  std::string does;
  bool takes_value = false;
  bool may_repeat = false;
  Words values;            ///< Those that are known.
  bool takes_file = true;  ///< The value may also be a file.
};

/// A call as far as its verbs go, "heel experiment follow", and what may come next.
struct Call {
  std::string words;
  std::string does;
  std::vector<Offer> options, arguments;
  std::vector<Call> verbs;
};

Offer offerOf(const CLI::Option& option) {
  Offer offer;
  for (const std::string& name : option.get_lnames()) offer.names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) offer.names.push_back("-" + name);
  if (option.get_positional()) offer.names = {option.get_name(true)};
  offer.does = option.get_description();
  offer.takes_value = option.get_items_expected_max() > 0;
  offer.may_repeat = option.get_expected_max() > 1;
  // CLI11 writes the set that a value must be of as "TEXT:{fixed,drawn}", or with what it
  // stands for as "{all->2}".
  const std::string type = option.get_type_name();
  const auto begin = type.find('{'), end = type.find('}');
  if (begin != std::string::npos && end != std::string::npos) {
    offer.values = CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
    for (std::string& value : offer.values) value.resize(std::min(value.find("->"), value.size()));
    offer.takes_file = false;
  }
  static const std::set<std::string> of_scenes = {"SCENE", "MAP", "SOURCE", "--map"};
  if (of_scenes.count(offer.names.front()) > 0) offer.values = namesIn(sceneFolder());
  static const std::set<std::string> of_robots = {"ROBOT", "--config"};
  if (of_robots.count(offer.names.front()) > 0) offer.values = namesIn(robotFolder());
  if (offer.names.front() == "--plan") offer.values = namesIn(planFolder());
  if (offer.names.front() == "--drive") offer.values = {"roam"};
  return offer;
}

Call callOf(const CLI::App& app, const std::string& before = "") {
  Call call{before + app.get_name(), app.get_description(), {}, {}, {}};
  for (const CLI::Option* option : app.get_options()) {
    (option->get_positional() ? call.arguments : call.options).push_back(offerOf(*option));
  }
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    call.verbs.push_back(callOf(*verb, call.words + " "));
  }
  return call;
}

/// Calls `visit` with the call and all below it.
template <typename Visit>
void visitCalls(const Call& call, const Visit& visit) {
  visit(call);
  for (const Call& verb : call.verbs) visitCalls(verb, visit);
}

std::string lastWord(const Call& call) { return call.words.substr(call.words.rfind(' ') + 1); }

/// "'heel learn' | 'heel track'": a pattern of the calls that have a verb, or one more.
std::string patternOfVerbs(const Call& root) {
  Words patterns;
  visitCalls(root, [&](const Call& call) {
    if (&call != &root) patterns.push_back("'" + call.words + "'");
  });
  return joined(patterns, " | ");
}

// Files are left to bash itself: it offers them where nothing else fits.
std::string bashCompletion(const Call& root) {
  std::string after_options, after_calls;
  Words without_words;
  visitCalls(root, [&](const Call& call) {
    Words options, words;
    for (const Offer& offer : call.options) {
      options.insert(options.end(), offer.names.begin(), offer.names.end());
      if (!offer.takes_value) continue;
      const std::string pattern = "'" + call.words + " " + offer.names.front() + "'";
      if (offer.values.empty()) {
        without_words.push_back(pattern);
        continue;
      }
      after_options += "    " + pattern + ") words='" + joined(offer.values) + "' ;;\n";
    }
    for (const Call& verb : call.verbs) words.push_back(lastWord(verb));
    for (const Offer& offer : call.arguments) {
      words.insert(words.end(), offer.values.begin(), offer.values.end());
    }
    after_calls += "        '" + call.words + "') words='" + joined(words) + "' options='" +
                   joined(options) + "' ;;\n";
  });
  return "# Completion for bash, made by 'heel completion bash'.\n"
         "_heel() {\n"
         "  local call=heel current=${COMP_WORDS[COMP_CWORD]} last=$((COMP_CWORD - 1)) i\n"
         "  local words= options=\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case \"$call ${COMP_WORDS[i]}\" in\n"
         "      " +
         patternOfVerbs(root) +
         ") call+=\" ${COMP_WORDS[i]}\" ;;\n"
         "    esac\n"
         "  done\n"
         "  # --light=fixed comes in three words.\n"
         "  [[ $current == = ]] && current=\n"
         "  [[ ${COMP_WORDS[last]} == = ]] && ((--last))\n"
         "  case \"$call ${COMP_WORDS[last]}\" in\n" +
         after_options + "    " + joined(without_words, " | ") +
         ") ;;\n"
         "    *)\n"
         "      case \"$call\" in\n" +
         after_calls +
         "      esac\n"
         "      [[ $current == -* ]] && words=$options\n"
         "      ;;\n"
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "}\n"
         "complete -o bashdefault -o default -F _heel heel\n";
}

/// The first clause of a description, in zsh's single quotes, where it may stand in brackets.
std::string zshText(const std::string& text) {
  std::string quoted;
  for (const char c : text.substr(0, std::min(text.find(" ("), text.find(';')))) {
    if (c == '\'') {
      quoted += "'\\'";
    } else if (c == '[' || c == ']' || c == ':' || c == '\\') {
      quoted += '\\';
    }
    quoted += c;
  }
  return quoted;
}

/// ":SCENE:{compadd home office; _files}": what may be the value of an option or an argument.
std::string zshValue(const Offer& offer) {
  std::string action = "_files";
  if (!offer.values.empty()) {
    action = "compadd -- " + joined(offer.values);
    action = "{" + action + (offer.takes_file ? "; _files" : "") + "}";
  }
  return ":" + offer.names.front() + ":" + action;
}

std::string zshCompletion(const Call& root) {
  std::string calls;
  visitCalls(root, [&](const Call& call) {
    calls += "    ('" + call.words + "')\n      _arguments";
    for (const Offer& offer : call.options) {
      for (const std::string& name : offer.names) {
        calls += " \\\n        '" + name + "[" + zshText(offer.does) + "]" +
                 (offer.takes_value ? zshValue(offer) : "") + "'";
      }
    }
    int place = 0;
    for (const Offer& offer : call.arguments) {
      const std::string at = offer.may_repeat ? "*" : std::to_string(++place);
      calls += " \\\n        '" + at + zshValue(offer) + "'";
    }
    if (!call.verbs.empty()) {
      calls += " \\\n        '1:verb:((";
      for (const Call& verb : call.verbs) {
        calls += "\n          " + lastWord(verb) + "\\:\"" + zshText(verb.does) + "\"";
      }
      calls += "))'";
    }
    calls += " ;;\n";
  });
  return "#compdef heel\n"
         "# Completion for zsh, made by 'heel completion zsh'.\n"
         "_heel() {\n"
         "  local call=heel at=1 i\n"
         "  for ((i = 2; i < CURRENT; ++i)); do\n"
         "    case \"$call $words[i]\" in\n"
         "      (" +
         patternOfVerbs(root) +
         ") call+=\" $words[i]\" at=$i ;;\n"
         "    esac\n"
         "  done\n"
         "  shift $((at - 1)) words\n"
         "  ((CURRENT -= at - 1))\n"
         "  case $call in\n" +
         calls +
         "  esac\n"
         "}\n"
         "_heel \"$@\"\n";
}

}  // namespace

void addCompletion(CLI::App& app) {
  auto shell = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("completion", "Print what completes calls in a shell");
  verb->footer(
      "Example:\n"
      "  heel completion bash > ~/.local/share/bash-completion/completions/heel\n"
      "The Debian package installs it for bash and zsh.");
  verb->add_option("SHELL", *shell, "whose completion")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh"}));
  verb->callback([&app, shell] {
    const Call root = callOf(app);
    std::fputs((*shell == "bash" ? bashCompletion(root) : zshCompletion(root)).c_str(), stdout);
  });
}

}  // namespace heel
