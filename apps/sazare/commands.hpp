#pragma once

/// The commands of the program, each from its arguments to an exit code. They throw UserError, PhysicsError, MachineError.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sazare/parallel/ranks.hpp"
#include "sazare/runs/run_folder.hpp"

namespace sazare::command {

inline constexpr int done = 0;
inline constexpr int stopped = 4;

/// What `run` and `check` share.
struct CaseArguments {
  std::filesystem::path file;
  std::vector<std::string> settings;  ///< of --set
  int threads = 0;                    ///< 0: as many as the machine offers
};

struct RunArguments {
  CaseArguments of_case;
  std::filesystem::path folder;  ///< empty: runs/<name of the case>
  bool resume = false;
  bool overwrite = false;
  bool quiet = false;
  std::string balance;                ///< how ranks share the work: one of distribute::policy_names; empty: the best there is
  int balance_interval = 50;          ///< base steps between new shares
  std::string side;                   ///< of a hybrid case, where the other one is in another program: continuum or bodies
  std::filesystem::path exchange;     ///< folder of both programs; empty: runs/<name of the case>/exchange
  double time_out = 600;              ///< how long to wait for the other program [s]
};

struct CheckArguments {
  CaseArguments of_case;
  int ranks = 0;                  ///< tell how so many processes would share the case; 0: nothing
  std::filesystem::path picture;  ///< of the model, drawn by Python; empty: none
};

struct StudyArguments {
  std::filesystem::path file;
  std::filesystem::path folder;  ///< empty: runs/<name of the study>
  int threads = 0;               ///< cases at a time; 0: as many as the machine offers
  bool resume = false;
  bool overwrite = false;
  bool quiet = false;
};

/// Sets the number of threads that was asked for, 0 for as many as there are; not more than the processors, which is told.
void use_threads(int asked, bool speaks);
int run(const RunArguments& arguments, const parallel::Ranks& ranks);
int study(const StudyArguments& arguments);
int check(const CheckArguments& arguments);
/// A command that the Python package carries out, with its arguments: {"report", "build/demo"}.
int in_python(std::vector<std::string> arguments);
/// What to print of what the program knows about its files.
enum class Schema { json, page, folder };
int schema(Schema what);
int info(const parallel::Ranks& ranks);

}  // namespace sazare::command
