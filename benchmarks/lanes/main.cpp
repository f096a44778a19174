/// Two kernels on the vectors of the engine, of std::experimental::simd and of Highway: nanoseconds of processor time of one
/// evaluation. The back ends take turns in every round, so that a core whose speed changes changes it for all. Printed are the
/// medians over the rounds of the time and of its ratio to the first, and how far results differ from those of the first.

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/lanes/contact_kernel.hpp"
#include "benchmarks/lanes/joint_kernel.hpp"

namespace sazare::bench {

namespace {

Real processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<Real>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<Real>(usage.ru_utime.tv_usec);
}

struct Entry {
  std::string name;
  std::function<void()> evaluate;
  std::function<Real()> check;
  std::vector<Real> nanoseconds;
};

Real median(std::vector<Real> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Scenes live as long as the functions of the entry.
template <class Kernel, class Scene>
Entry entry(int size) {
  auto scene = std::make_shared<Scene>(size);
  auto kernel = std::make_shared<Kernel>(*scene);
  return {Kernel::name, [scene, kernel] { kernel->evaluate(); }, [kernel] { return kernel->check(); }, {}};
}

void measure(const char* title, std::vector<Entry> entries, std::size_t evaluations, int rounds, int repeats) {
  std::vector<Real> checks;
  for (Entry& each : entries) {
    each.evaluate();
    checks.push_back(each.check());
  }
  for (int round = 0; round < rounds; ++round)
    for (Entry& each : entries) {
      const Real begin = processor_seconds();
      for (int n = 0; n < repeats; ++n) each.evaluate();
      const Real seconds = processor_seconds() - begin;
      each.nanoseconds.push_back(1e9 * seconds / repeats / static_cast<Real>(evaluations));
    }
  std::printf("%s\n%-42s %10s %8s %12s\n", title, "vectors", "ns each", "time", "difference");
  for (std::size_t n = 0; n < entries.size(); ++n) {
    std::vector<Real> ratios;  // round by round
    for (int round = 0; round < rounds; ++round) {
      const auto r = static_cast<std::size_t>(round);
      ratios.push_back(entries[n].nanoseconds[r] / entries[0].nanoseconds[r]);
    }
    std::printf("%-42s %10.2f %8.3f %12.1e\n", entries[n].name.c_str(), median(entries[n].nanoseconds), median(ratios),
                std::abs(checks[n] / checks[0] - 1));
  }
  std::printf("\n");
}

template <template <class> class Kernel, class Scene>
std::vector<Entry> entries(int size) {
  return {entry<Kernel<OwnOps>, Scene>(size),
          entry<Kernel<StandardOps<Extras::all>>, Scene>(size),
          entry<Kernel<StandardOps<Extras::root>>, Scene>(size),
          entry<Kernel<StandardOps<Extras::none>>, Scene>(size),
          entry<Kernel<HighwayOps<Extras::all>>, Scene>(size),
          entry<Kernel<HighwayOps<Extras::root>>, Scene>(size),
          entry<Kernel<HighwayOps<Extras::none>>, Scene>(size)};
}

}  // namespace

}  // namespace sazare::bench

int main(int count, char** words) {
  using namespace sazare::bench;
  const int rounds = count > 1 ? std::stoi(words[1]) : 21;
  const int edge = 10, blocks = 513;
  const auto contacts = ContactScene(edge).size(), joints = JointScene(blocks).size();
  measure("contacts of spheres", entries<ContactKernel, ContactScene>(edge), contacts, rounds, 400);
  measure("joints of blocks", entries<JointKernel, JointScene>(blocks), joints, rounds, 400);
}
