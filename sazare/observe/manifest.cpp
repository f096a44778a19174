#include "sazare/observe/manifest.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "sazare/core/version.hpp"
#include "sazare/observe/atomic_file.hpp"
#include "sazare/observe/hash.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::observe {
namespace {

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

nlohmann::ordered_json results_of(const Manifest& manifest) {
  nlohmann::ordered_json results = nlohmann::ordered_json::object();
  for (const auto& [name, figure] : manifest.results) {
    std::visit([&, &key = name](const auto& value) { results[key] = value; }, figure);
  }
  results["ppv"] = nlohmann::ordered_json::object();
  for (const auto& [gauge, velocity] : manifest.peak_particle_velocity) results["ppv"][gauge] = velocity;
  return results;
}

}  // namespace

Machine this_machine() { return {cpu_model(), static_cast<int>(std::thread::hardware_concurrency()), parallel::threads()}; }

std::string time_of_day() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now));
}

Manifest new_manifest() {
  Manifest manifest;
  manifest.version = version;
  manifest.commit = commit;
  manifest.started = time_of_day();
  manifest.machine = this_machine();
  return manifest;
}

void write_manifest(const std::filesystem::path& file, const Manifest& manifest) {
  const Machine& machine = manifest.machine;
  const nlohmann::ordered_json json = {
      {"sazare", manifest.version},
      {"commit", manifest.commit},
      {"case", manifest.case_title},
      {"method", manifest.method},
      {"status", manifest.status},
      {"started", manifest.started},
      {"finished", manifest.finished},
      {"machine", {{"cpu", machine.cpu}, {"cores", machine.cores}, {"threads", machine.threads}, {"ranks", machine.ranks}}},
      {"state_hash", to_hex(manifest.state_hash)},
      {"results", results_of(manifest)}};
  // Texts of the user may hold bytes that are no UTF-8; they are replaced.
  write_file(file, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace sazare::observe
