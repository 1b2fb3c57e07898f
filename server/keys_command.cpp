#include "server/keys_command.h"

#include <CLI/CLI.hpp>
#include <iostream>

#include "server/config_file.h"
#include "server/key_file.h"

namespace spherematch {

namespace {

void add(const std::string& file, const std::string& name, const std::string& scope) {
  const std::string key = add_key(file, name, scope_of(scope).value());
  std::cerr << "The new key, which is shown only now; " << file << " keeps its SHA-256:\n";
  std::cout << key << std::endl;
}

void list(const std::string& file) {
  for (const Key& key : read_key_file(file)) std::cout << key.name << " " << to_string(key.scope) << " " << key.made << "\n";
}

}  // namespace

int keys_command(int argc, const char* const* argv) {
  std::string file;
  std::string name;
  std::string scope = "read";
  CLI::App app("Changes the file of keys; a running server takes it up at once", "spherematch-server keys");
  app.require_subcommand(1);
  app.fallthrough();
  app.add_option("--keys", file, "File of keys")->envname(variable_of("keys"))->required();
  const auto add_name = [&name](CLI::App* command) { command->add_option("--name", name, "The key's name")->required(); };
  CLI::App* const adding = app.add_subcommand("add", "Make a key and print it; the file is made where it is missing");
  add_name(adding);
  adding->add_option("--scope", scope, "What the key allows")->check(CLI::IsMember({"read", "write", "admin"}))->capture_default_str();
  CLI::App* const listing = app.add_subcommand("list", "Print name, scope and date of every key");
  CLI::App* const removing = app.add_subcommand("remove", "Take a key out");
  add_name(removing);
  try {
    app.parse(argc, argv);
    if (adding->parsed()) add(file, name, scope);
    if (listing->parsed()) list(file);
    if (removing->parsed()) remove_key(file, name);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "spherematch-server keys: " << error.what() << "\n";
    return 1;
  }
}

}  // namespace spherematch
