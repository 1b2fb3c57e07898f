#include "server/config_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <memory>
#include <set>

namespace spherematch {

namespace {

std::string value_of_variable(const std::string& name) {
  const char* const value = std::getenv(name.c_str());
  return value == nullptr ? std::string() : value;
}

/// CLI11 lets a file win over the environment and passes over much that is likely a mistake.
class StrictConfig final : public CLI::ConfigTOML {
 public:
  explicit StrictConfig(const CLI::App& app) : app_(app) {}

  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
    std::vector<CLI::ConfigItem> items = CLI::ConfigTOML::from_config(input);
    std::set<std::string> seen;
    for (const CLI::ConfigItem& item : items) {
      if (!item.parents.empty()) throw CLI::ConfigError("the configuration file has a section, or a key with a dot; it knows neither");
      // Several values of one key arrive as one item where its lines follow each other, and an unquoted space separates values.
      if (item.inputs.size() != 1 || !seen.insert(item.name).second) {
        throw CLI::ConfigError("configuration file: " + item.name + " has several values; give one, in quotes where it has spaces");
      }
      // Left over of a quoted value that a '#' has cut.
      if (item.inputs.front().starts_with('"') || item.inputs.front().starts_with('\'')) {
        throw CLI::ConfigError("configuration file: the quotes of " + item.name + " do not end, or hold a '#'");
      }
    }
    std::erase_if(items, [this](const CLI::ConfigItem& item) { return is_in_environment(item.name); });
    return items;
  }

 private:
  [[nodiscard]] bool is_in_environment(const std::string& flag) const {
    const CLI::Option* const option = app_.get_option_no_throw("--" + flag);
    return option != nullptr && !option->get_envname().empty() && !value_of_variable(option->get_envname()).empty();
  }

  const CLI::App& app_;
};

}  // namespace

std::string variable_of(const std::string& flag) {
  std::string variable = "SPHEREMATCH_" + flag;
  std::transform(variable.begin(), variable.end(), variable.begin(),
                 [](unsigned char c) { return c == '-' ? '_' : static_cast<char>(std::toupper(c)); });
  return variable;
}

void add_config_file(CLI::App& app) {
  // CLI11 opens the file before it looks at the environment, so the variable's value is handed over as the default.
  const std::string file = value_of_variable(variable_of("config"));
  app.set_config("--config", file, "File of lines flag = value", /*config_required=*/!file.empty())
      ->envname(variable_of("config"))
      ->type_name("FILE")
      ->required(!file.empty());
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.config_formatter(std::make_shared<StrictConfig>(app));
}

}  // namespace spherematch
