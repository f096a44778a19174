/// The parts of a simulation that several processes of a run need.

#include "sazare/levels/simulation.hpp"
#include "sazare/parallel/threads.hpp"

namespace sazare::levels {

namespace {
}  // namespace

template <int D>
void Simulation<D>::count_work(std::size_t kind, std::size_t count, Real since) {
  own_work_.seconds[kind] += parallel::processor_seconds() - since;
  own_work_.count[kind] += static_cast<std::int64_t>(count);
}

template <int D>
void Simulation<D>::collect() {
  if (replicas_) replicas_->collect(work_, parallel::To::first);
}

/// By kind of work (the links of each term, then kicks) and body: how often its owner does it in a base step, as levels
/// stand now. A link within a range counts half for each of its bodies; one between ranges is evaluated by both.
template <int D>
std::vector<std::vector<Real>> Simulation<D>::due_in_base_step() const {
  std::vector<std::vector<Real>> due(terms_.size() + 1, std::vector<Real>(at(bodies_.size()), 0));
  for (std::size_t term = 0; term < terms_.size(); ++term) {
    const auto links = terms_[term]->links();
    for (std::size_t number = 0; number < links.size(); ++number) {
      if (!levels_.clock(term).holds(static_cast<Index>(number))) continue;
      const Link& link = links[number];
      const auto times = static_cast<Real>(Tick{1} << levels_.clock(term).level(static_cast<Index>(number)));
      const bool shared = link.second != Link::outside;
      const Real part = shared && replicas_->ranges().owner(link.first) == replicas_->ranges().owner(link.second) ? 0.5 : 1;
      due[term][at(link.first)] += part * times;
      if (shared) due[term][at(link.second)] += part * times;
    }
  }
  for (Index body = 0; body < bodies_.size(); ++body)
    due.back()[at(body)] = static_cast<Real>(Tick{1} << levels_.active_level(body));
  return due;
}

/// Cuts the ranges anew from what the last interval has cost.
template <int D>
void Simulation<D>::divide_anew() {
  Parcel own;
  parallel::Traffic traffic = replicas_->ranks().traffic();
  own(own_work_.seconds);
  own(own_work_.count);
  own(traffic);
  const parallel::Gathered gathered = replicas_->ranks().gather(own.packed());
  std::vector<distribute::Work> work(static_cast<std::size_t>(replicas_->ranks().size()));
  for (int rank = 0; rank < replicas_->ranks().size(); ++rank) {
    Parcel arrived(gathered.of(rank));
    distribute::Work& of = work[static_cast<std::size_t>(rank)];
    arrived(of.seconds);
    arrived(of.count);
    arrived(traffic);
    rank_work_.push_back({now_.tick, rank, of.total(), traffic.seconds, traffic.bytes, replicas_->ranges().begin(rank)});
  }
  std::ranges::fill(own_work_.seconds, 0);
  std::ranges::fill(own_work_.count, 0);
  const bool looks_ahead = balance_.policy() == distribute::Policy::predicted;
  distribute::Ranges next =
      balance_.cut(replicas_->ranges(), work, looks_ahead ? due_in_base_step() : std::vector<std::vector<Real>>{});
  take_ranges(std::move(next));
}

template <int D>
void Simulation<D>::take_ranges(distribute::Ranges next) {
  if (next == replicas_->ranges()) return;
  replicas_->collect(work_, parallel::To::all);
  replicas_->divide(std::move(next));
}

template void Simulation<2>::count_work(std::size_t, std::size_t, Real);
template void Simulation<3>::count_work(std::size_t, std::size_t, Real);
template void Simulation<2>::collect();
template void Simulation<3>::collect();
template std::vector<std::vector<Real>> Simulation<2>::due_in_base_step() const;
template std::vector<std::vector<Real>> Simulation<3>::due_in_base_step() const;
template void Simulation<2>::take_ranges(distribute::Ranges);
template void Simulation<3>::take_ranges(distribute::Ranges);
template void Simulation<2>::divide_anew();
template void Simulation<3>::divide_anew();

}  // namespace sazare::levels
