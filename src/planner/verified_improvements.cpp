#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "obstacle_view.hpp"
#include "verified_planner.hpp"

namespace slalom::planner {
namespace {

/// This near to its arrival a plan is not improved on [s].
constexpr double kNearlyThere = 1;
/// The longest wait until a better plan is looked for again, in improvement periods.
constexpr double kLongestWaits = 8;
/// Work of one turn between two looks at the clock, in places.
constexpr double kTurn = 10'000;

}  // namespace

/// Whether something better than the rest is to be looked for.
bool VerifiedPlanner::due(const Cycle& cycle) const {
  return !cycle.leads() || (cycle.t_start() - last_improved_ >= wait_ - kSameTime &&
                            cycle.arrival() - cycle.t_start() >= kNearlyThere);
}

/// Asks for proposals that begin when they are expected to be there, where the rest leads by then.
void VerifiedPlanner::ask(Cycle& cycle) {
  const Settings& s = task_.planner;
  const bool leads = cycle.leads();
  last_improved_ = cycle.t_start();
  // Until a plan is better, each search is waited for longer than the one before.
  wait_ = leads ? std::min(2 * wait_, kLongestWaits * s.improvement_period) : s.improvement_period;
  Proposals::Question question;
  question.from = cycle.request.X0p;
  question.t_from = cycle.t_start();
  question.looks = cycle.looks();
  question.beyond = cycle.beyond();
  question.obstacles = cycle.obstacles;
  question.need = need(cycle);
  question.places = leads ? s.improvement_places : s.search_places;
  question.ways = leads ? 1 : s.ways;
  if (leads && task_.goal.kind() != world::GoalKind::time) question.arrival = cycle.arrival();
  if (cycle.rest && cycle.trusts(*cycle.rest)) {
    const Motion& rest = cycle.rest->motion();
    const double a_cycle =
        leads ? cycle.for_better(s.improvement_time) : std::max(cycle.left(), 1e-3);
    const double ahead = std::ceil(expected_work_ / (Proposals::kPlacesPerSecond * a_cycle)) - 1;
    const double t = cycle.t_start() + std::max(ahead, 0.0) * cycle.tex();
    Motion lead = rest;
    if (t > cycle.t_start() && t < rest.end() - kSameTime) {
      lead = part_from(rest, t, plant_);
      question.from = lead.states[0];
      question.t_from = t;
    }
    if (cycle.rest->proposal.verdict.end == MotionEnd::arrives && !cycle.rest->proposal.solved)
      question.rest = std::move(lead);
  }
  work_before_ = proposals_.turns().work();
  asked_while_leading_ = leads;
  proposals_.ask(std::move(question));
}

/// Looks for what is better. As long as something leads to the goal, so much is done in a cycle;
/// else all there is time for in a share of what is left of the cycle.
void VerifiedPlanner::look_further(Cycle& cycle, double share) {
  if (!adopt_found(cycle, true)) return;
  Turns& turns = proposals_.turns();
  const bool leads = cycle.leads();
  if (!leads && asked_while_leading_) turns.cancel();
  if (!turns.under_way() && due(cycle)) ask(cycle);
  const double before = turns.cpu_s() - cycle.beside_s;
  double work = leads && !cycle.request.warm_up
                    ? Proposals::kPlacesPerSecond * cycle.for_better(task_.planner.improvement_time)
                    : std::numeric_limits<double>::infinity();
  const auto others = [share](double left) { return std::isinf(left) ? 0 : (1 - share) * left; };
  const double cpu = others(cycle.left()), clock = others(cycle.clock_left());
  while (turns.under_way() && work > 0 && !cycle.over() && cycle.left() > cpu &&
         cycle.clock_left() > clock) {
    const double turn = std::min(work, kTurn);
    turns.go_on({turn, cycle.left() - cpu, cycle.clock_left() - clock});
    work -= turn;
    cycle.beside_s = turns.cpu_s() - before;
    cycle.iterations += proposals_.take_iterations();
    if (!adopt_found(cycle, false) || turns.wants_more()) break;
  }
  if (!turns.under_way()) expected_work_ = turns.work() - work_before_;
}

/// Adopts what was found and not adopted yet, the first in any case if `one_at_least`. Where
/// something leads to the goal, what the cycle has no time for waits for the next one. Whether none
/// waits.
bool VerifiedPlanner::adopt_found(Cycle& cycle, bool one_at_least) {
  for (; proposals_.found(); one_at_least = false) {
    const double left = std::min(cycle.left(), cycle.clock_left());
    if (cycle.leads() && !one_at_least && left < longest_adoption_s_) return false;
    const Timer timer;
    adopt(cycle, proposals_.take());
    longest_adoption_s_ = std::max(longest_adoption_s_, timer.cpu());
  }
  return true;
}

/// A proposal from where the cycle is. One that begins elsewhere is tracked from here, at first
/// along the rest.
void VerifiedPlanner::adopt(Cycle& cycle, const Proposal& proposal) {
  const auto& question = proposals_.question();
  const double t0 = cycle.t_start();
  if (question.t_from == t0 && question.from == cycle.request.X0p &&
      same(question.obstacles, cycle.obstacles)) {
    follow(cycle, proposal);
    return;
  }
  const Motion& found = proposal.motion;
  if (found.size() < 2 || found.end() <= t0 + kSameTime) return;
  Motion reference;
  if (cycle.rest && t0 < found.begin())
    reference = part_before(cycle.rest->motion(), found.begin());
  reference.append(found);
  follow(cycle, judged(cycle, proposal.name,
                       tracker_.follow(reference, cycle.request.X0p, t0, reference.end()),
                       proposal.solved));
}

}  // namespace slalom::planner
