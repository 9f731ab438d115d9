// completion: a script that lets a shell complete commands, options and their values; and complete, hidden, which such
// a script asks for what may come next.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engines/adapters.hpp"
#include "engines/engine.hpp"
#include "engines/zoo/mutants.hpp"
#include "engines/zoo/unsteady.hpp"
#include "golden/families.hpp"
#include "proptests/law.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/usage.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

// What `complete` prints: a line for each word that may stand where the cursor is, with what it means behind a tab; and
// one of these two where a file or a folder may, of which the shell knows more. All else is left to the shell's script.
constexpr std::string_view kFiles = ":files";
constexpr std::string_view kFolders = ":folders";

struct Candidate {
  std::string word;
  std::string about;
};
using Candidates = std::vector<Candidate>;

/// The engines whose name begins so; of those that are one of many, the beginning they share until it is there.
Candidates engine_names(std::string_view begun) {
  Candidates found;
  for (const engines::BuiltIn& e : engines::built_in_engines())
    found.push_back({std::string(e.name), std::string(e.about)});
  for (const engines::Adapter& a : engines::adapters()) found.push_back({std::string(a.name), std::string(a.about)});
  const auto add = [&](std::string_view prefix, const auto& all, std::string_view what) {
    if (!begun.starts_with(prefix)) found.push_back({std::string(prefix), std::string(what)});
    if (begun.starts_with(prefix))
      for (const auto& one : all) found.push_back({fmt::format("{}{}", prefix, one.id), std::string(one.about)});
  };
  add(engines::kMutantPrefix, engines::mutants(), "an engine with one mistake");
  add(engines::kUnsteadyPrefix, engines::unsteady_engines(), "an engine that --determinism refutes");
  return found;
}

Candidates family_names() {
  Candidates found;
  std::set<std::string_view> names;
  for (const Pair pair : pairs_of_kinds())
    for (const golden::Family& f : golden::families_of(pair))
      if (names.insert(f.name).second) found.push_back({std::string(f.name), std::string(f.reason)});
  return found;
}

Candidates law_names() {
  Candidates found;
  for (const proptests::Law& law : proptests::laws())
    found.push_back({std::string(law.name), std::string(law.sentence)});
  return found;
}

Candidates command_names(const CLI::App& app) {
  Candidates found;
  for (const CommandGroup& group : command_groups(app))
    for (const CLI::App* command : group.commands)
      found.push_back({command->get_name(), description_of(*command).first});
  return found;
}

/// What an option's value may be, where `begun` has been typed of it.
Candidates values_of(const OptionUsage& usage, const CLI::App& app, const std::string& begun) {
  if (!usage.choices.empty()) {
    Candidates found;
    for (const std::string& choice : usage.choices) found.push_back({choice, ""});
    return found;
  }
  if (usage.value == "ENGINE") return engine_names(begun);
  if (usage.value == "FAMILY") return family_names();
  if (usage.value == "LAW") return law_names();
  if (usage.value == "COMMAND") {
    Candidates found = command_names(app);
    found.push_back({"all", "every command"});
    return found;
  }
  if (usage.value == "FILE") return {{std::string(kFiles), ""}};
  if (usage.value == "FOLDER") return {{std::string(kFolders), ""}};
  return {};
}

/// The option of that name, of the command or of those above it.
const CLI::Option* find_option(const CLI::App& command, const std::string& name) {
  for (const CLI::App* app = &command; app != nullptr; app = app->get_parent())
    if (const CLI::Option* option = app->get_option_no_throw(name)) return option;
  return nullptr;
}

/// A command line as far as it has been typed.
class Typed {
 public:
  explicit Typed(const CLI::App& app) : app_(app), command_(&app) {}

  void add(const std::string& word) {
    if (options_end_ || waiting_ != nullptr) {
      const bool value = waiting_ != nullptr && !(may_stand_alone() && word.starts_with('-'));
      waiting_ = nullptr;
      if (value || options_end_) return;
    }
    if (word == "--") {
      options_end_ = true;
    } else if (word.size() > 1 && word.starts_with('-')) {
      const CLI::Option* option = find_option(*command_, word);
      if (option != nullptr && option->get_items_expected_max() != 0) waiting_ = option;
    } else if (const CLI::App* command = find_command(*command_, word)) {
      command_ = command;
    }
  }

  /// What may stand in the place of the word that is being typed.
  [[nodiscard]] Candidates next(const std::string& word) const {
    Candidates found;
    const std::size_t equals = word.find('=');
    if (waiting_ != nullptr) add_values(found, *waiting_, "", word);
    if (waiting_ != nullptr && !may_stand_alone()) return found;
    if (!options_end_ && word.starts_with("--") && equals != std::string::npos) {
      if (const CLI::Option* option = find_option(*command_, word.substr(0, equals)))
        add_values(found, *option, word.substr(0, equals + 1), word.substr(equals + 1));
    } else if (!options_end_ && word.starts_with('-')) {
      add_options(found, word);
    } else if (waiting_ == nullptr) {
      const Candidates commands = options_end_ ? Candidates() : command_names(*command_);
      std::copy_if(commands.begin(), commands.end(), std::back_inserter(found),
                   [&](const Candidate& c) { return c.word.starts_with(word); });
      for (const CLI::Option* option : command_->get_options())
        if (option->get_positional() && !option->get_group().empty()) add_values(found, *option, "", word);
    }
    return found;
  }

 private:
  [[nodiscard]] bool may_stand_alone() const { return waiting_->get_items_expected_min() == 0; }

  void add_values(Candidates& found, const CLI::Option& option, const std::string& before,
                  const std::string& word) const {
    const OptionUsage usage = usage_of(option);
    // Of several in one word the last is completed.
    const std::size_t done = usage.delimiter == '\0' ? 0 : word.rfind(usage.delimiter) + 1;
    const std::string begun = word.substr(done);
    for (Candidate& c : values_of(option.get_positional() ? of_argument(option, usage) : usage, app_, begun)) {
      if (c.word == kFiles || c.word == kFolders)
        found.push_back(std::move(c));
      else if (c.word.starts_with(begun))
        found.push_back({before + word.substr(0, done) + c.word, c.about});
    }
  }

  /// An argument is shown by its name, and its value is what its type says, else a file.
  [[nodiscard]] static OptionUsage of_argument(const CLI::Option& option, OptionUsage usage) {
    const std::string type = option.get_type_name();
    usage.value = type.starts_with("TEXT") ? "FILE" : type;
    return usage;
  }

  void add_options(Candidates& found, const std::string& word) const {
    for (const CLI::App* app = command_; app != nullptr; app = app->get_parent())
      for (const CLI::Option* option : app->get_options()) {
        if (option->get_positional() || option->get_group().empty()) continue;
        const OptionUsage usage = usage_of(*option);
        for (const std::string& name : usage.names)
          if (name.starts_with(word) &&
              std::none_of(found.begin(), found.end(), [&](const Candidate& other) { return other.word == name; }))
            found.push_back({name, usage.about});
      }
  }

  const CLI::App& app_;
  const CLI::App* command_;
  const CLI::Option* waiting_ = nullptr;  ///< for its value
  bool options_end_ = false;              ///< behind --
};

void complete(const CLI::App& app, const std::vector<std::string>& words) {
  Typed typed(app);
  for (std::size_t i = 0; i + 1 < words.size(); ++i) typed.add(words[i]);
  for (const Candidate& c : typed.next(words.empty() ? "" : words.back()))
    fmt::print("{}{}{}\n", c.word, c.about.empty() ? "" : "\t", c.about);
}

struct ShellScript {
  std::string_view shell;
  std::string_view text;
};

constexpr std::array<ShellScript, 3> kScripts{{
    {"bash", R"SCRIPT(# bash completion of contact-oracle, which is asked what may come next.
_contact_oracle() {
  local -a words=()
  local word line current cut breaks= joined=
  local i
  # Readline cuts words at = and :, and the program does not.
  for ((i = 1; i <= COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    if [[ ${#words[@]} -gt 0 && ( -n $joined || $word == [=:] ) ]]; then
      words[-1]+=$word
    else
      words+=("$word")
    fi
    joined=
    if [[ $word == [=:] ]]; then joined=1; fi
  done
  current=${words[-1]}
  # What stands before the last of these stays as it is.
  if [[ $COMP_WORDBREAKS == *=* ]]; then breaks+='='; fi
  if [[ $COMP_WORDBREAKS == *:* ]]; then breaks+=':'; fi
  cut=
  if [[ -n $breaks && $current == *[$breaks]* ]]; then cut=${current%"${current##*[$breaks]}"}; fi
  local file=${current#"$cut"}
  if [[ $current == --*=* ]]; then file=${current#*=}; fi
  COMPREPLY=()
  while IFS= read -r line; do
    case $line in
      :files)
        compopt -o filenames 2>/dev/null
        while IFS= read -r word; do COMPREPLY+=("$word"); done < <(compgen -f -- "$file")
        ;;
      :folders)
        compopt -o filenames 2>/dev/null
        while IFS= read -r word; do COMPREPLY+=("$word"); done < <(compgen -d -- "$file")
        ;;
      *)
        word=${line%%$'\t'*}
        if [[ $word == *[:=] ]]; then compopt -o nospace 2>/dev/null; fi
        COMPREPLY+=("${word#"$cut"}")
        ;;
    esac
  done < <("${COMP_WORDS[0]/#\~/$HOME}" complete -- "${words[@]}" 2>/dev/null)
}
complete -F _contact_oracle contact-oracle
)SCRIPT"},
    {"zsh", R"SCRIPT(#compdef contact-oracle
# zsh completion of contact-oracle, which is asked what may come next.
_contact_oracle() {
  local line word
  local -a names shown begun
  local program=${(Q)words[1]}
  for line in "${(@f)$(${~program} complete -- "${(@Q)words[2,CURRENT-1]}" "${(Q)PREFIX}" 2>/dev/null)}"; do
    case $line in
      '') ;;
      :files)
        if [[ $PREFIX == --*=* ]]; then compset -P '*='; fi
        _files
        ;;
      :folders)
        if [[ $PREFIX == --*=* ]]; then compset -P '*='; fi
        _files -/
        ;;
      *)
        word=${line%%$'\t'*}
        if [[ $word == *[:=] ]]; then
          begun+=("$word")
        else
          names+=("$word")
          shown+=("${line/$'\t'/  -- }")
        fi
        ;;
    esac
  done
  if (( $#names )); then compadd -l -d shown -a names; fi
  if (( $#begun )); then compadd -S '' -a begun; fi
}
if [[ $funcstack[1] == _contact-oracle ]]; then
  _contact_oracle "$@"
else
  compdef _contact_oracle contact-oracle
fi
)SCRIPT"},
    {"fish", R"SCRIPT(# fish completion of contact-oracle, which is asked what may come next.
function __contact_oracle_answers
    set -l words (commandline -opc)
    set -l last (commandline -ct)
    set -l program $words[1]
    set -e words[1]
    $program complete -- $words "$last" 2>/dev/null
end
complete -c contact-oracle -f -a '(__contact_oracle_answers | string match -v ":*")'
complete -c contact-oracle -F -n 'contains -- :files (__contact_oracle_answers)'
complete -c contact-oracle -f -n 'contains -- :folders (__contact_oracle_answers)' -a '(__fish_complete_directories)'
)SCRIPT"},
}};

}  // namespace

void add_completion(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("completion", "A script that completes this command line in a shell");
  auto shell = std::make_shared<std::string>();
  std::vector<std::string> shells;
  for (const ShellScript& script : kScripts) shells.emplace_back(script.shell);
  command->add_option("shell", *shell, "The shell")->required()->check(CLI::IsMember(shells));
  command->footer(
      "bash: source <(contact-oracle completion bash)\n"
      "zsh:  source <(contact-oracle completion zsh), behind compinit\n"
      "fish: contact-oracle completion fish | source");
  command->callback([shell, &exit] {
    for (const ShellScript& script : kScripts)
      if (script.shell == *shell) fmt::print("{}", script.text);
    exit = kCertified;
  });
  // Its words are those of another command line, which may be anything.
  auto* asked = app.add_subcommand(kCompleteName, "What may come next on a command line, for `completion`'s scripts");
  asked->group("");
  auto words = std::make_shared<std::vector<std::string>>();
  asked->add_option("words", *words, "The command line so far, behind --");
  asked->callback([&app, words, &exit] {
    complete(app, *words);
    exit = kCertified;
  });
}

}  // namespace contact::tool
