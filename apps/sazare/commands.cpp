#include "apps/sazare/commands.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "sazare/cases/case_file.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::command {

int check(const CaseArguments& arguments) {
  use_threads(arguments.threads, true);
  const cases::CaseFile file = registry::read_case(arguments.file, arguments.settings);
  const std::string text = registry::check_case(file);
  fmt::print("{}", text);
  fmt::print(stderr, "{}", file.warnings);
  fmt::print("\nThe case is valid. To run it: sazare run {}\n", arguments.file.string());
  return done;
}

int schema(Schema what) {
  std::string text = what == Schema::folder ? registry::folder_markdown()
                     : what == Schema::page ? registry::schema_markdown()
                                            : registry::schema_json();
  if (!text.ends_with('\n')) text += '\n';
  fmt::print("{}", text);
  return done;
}

}  // namespace sazare::command
