#include "apps/sazare/commands.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "sazare/cases/case_file.hpp"
#include "sazare/registry/registry.hpp"

namespace sazare::command {

namespace {

int draw(const CheckArguments& arguments) {
  std::fflush(stdout);  // what was printed comes before what Python prints
  std::vector<std::string> words = {"model", arguments.of_case.file.string(), arguments.picture.string()};
  for (const std::string& setting : arguments.of_case.settings) words.push_back("--set=" + setting);
  return in_python(words);
}

}  // namespace

int check(const CheckArguments& arguments) {
  const CaseArguments& of_case = arguments.of_case;
  use_threads(of_case.threads, true);
  const cases::CaseFile file = registry::read_case(of_case.file, of_case.settings);
  fmt::print(stderr, "{}", file.warnings);  // first: an unusual number may be the reason of what is refused below
  const auto explain_ranks = registry::method(file.method).explain_ranks;
  if (arguments.ranks > 0 && !explain_ranks)
    throw UserError("--ranks: a run of this method is one process: remove --ranks, and use --threads");
  const std::string text = registry::check_case(file);
  fmt::print("{}", text);
  if (arguments.ranks > 0) fmt::print("{}", explain_ranks(file, arguments.ranks));
  fmt::print("\nThe case is valid. To run it: sazare run {}\n", of_case.file.string());
  return arguments.picture.empty() ? done : draw(arguments);
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
