#include "proposals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "obstacle_view.hpp"
#include "references.hpp"
#include "road_reference.hpp"

namespace slalom::planner {
namespace {

using namespace vehicle;

/// Obstacles farther from a guess than this [m] are left out of its OCP.
constexpr double kFar = 18;
/// Standing ones nearer than this to the edge of their margin have rows between the points [m].
constexpr double kClose = 1.5;
/// An obstacle that a tracked motion came too near to grows by the shortfall and this [m], so many
/// times.
constexpr double kRegrow = 0.08, kRegrowEdge = 0.03;
constexpr int kRounds = 5;
/// A way found while another leads to the goal is looked at if it is sooner by this [s].
constexpr double kSooner = 0.3;
/// What ways keep off beyond the clearance needed at first [m], and as much as that at the most.
constexpr double kWayClearance = 0.65;
/// Ways along the road keep so much more from obstacles and from edges [m], and use such a share of
/// what the vehicle can, one after the other; so many of those that are refused are solved.
struct RoadKept {
  double clearance, edge, limits;
};
constexpr std::array kRoadKept = {RoadKept{0.2, 0.15, 0.8}, RoadKept{0.03, 0.02, 0.95}};
constexpr std::size_t kRoadSolves = 2;
/// At last they keep from obstacles what the rest of a plan keeps, and this [m].
constexpr double kLesserSpare = 0.02;
/// Shorter motions are not solved [s].
constexpr double kShortest = 0.4;
/// A tracked motion that ends farther from its reference than this [m] has lost it, and its OCP
/// starts from the reference.
constexpr double kAstray = 5;
/// Without guidance the OCP starts straight on, at this speed at least [m/s].
constexpr double kStraightSpeed = 5;
/// Beyond a line across the road a motion is deep enough [m].
constexpr double kDeep = 1;
/// What other steps count beside a place that a search looks at, by their times on one machine.
constexpr double kIteration = 300, kMotion = 1000, kMaking = 4000;

bool cancelled(void* turns) {
  return static_cast<Turns*>(turns)->spend(kIteration);
}

/// How far within the goal a motion is deep enough.
double depth_of(const world::Goal& goal) {
  switch (goal.kind()) {
    case world::GoalKind::square:
      return goal.sigma / 2;
    case world::GoalKind::rectangle:
      return std::min(goal.length, goal.width) / 4;
    default:
      return kDeep;
  }
}

/// A place at a time [m, s].
struct Passed {
  double t, x, y;
};

/// Where a motion, whose knots may be seconds apart, takes a point `ahead` of the front axle.
std::vector<Passed> places_of(const Motion& motion, double ahead) {
  std::vector<Passed> places;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const double t0 = motion.t[k], t1 = motion.t[std::min(k + 1, motion.size() - 1)];
    const int parts = std::max(1, static_cast<int>(std::ceil((t1 - t0) / Tracker::kStep)));
    for (int part = 0; part < parts; ++part) {
      const double share = static_cast<double>(part) / parts;
      const State &a = motion.states[k], &b = motion.states[std::min(k + 1, motion.size() - 1)];
      Passed at{t0 + share * (t1 - t0), a[X] + share * (b[X] - a[X]), a[Y] + share * (b[Y] - a[Y])};
      if (ahead != 0) {
        const double psi = a[PSI] + share * (b[PSI] - a[PSI]);
        at.x += ahead * std::cos(psi);
        at.y += ahead * std::sin(psi);
      }
      places.push_back(at);
    }
  }
  return places;
}

/// Least distance to an obstacle's edge where it is there [m].
double least_distance(const world::Obstacle& o, const std::vector<Passed>& places) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& p : places)
    if (o.present(p.t, p.t))
      least = std::min(least, world::distance(o, p.x, p.y, p.t) - o.margin(p.t));
  return least;
}

}  // namespace

Proposals::Proposals(const Task& task, Tracker& tracker, Verifier& verifier)
    : task_(task),
      tracker_(tracker),
      verifier_(verifier),
      footprint_(task.vehicle),
      ways_(task, task.vehicle, task.planner.cover_excess),
      solver_(nlp::make_solver(to_string(task.planner.solver))) {
  if (task.road) road_ways_.emplace(task, task.vehicle);
}

void Proposals::forget() {
  turns_.cancel();
  found_.clear();
}

void Proposals::ask(Question question) {
  forget();
  question_ = std::move(question);
  turns_.begin([this] { look(); });
}

Proposal Proposals::take() {
  Proposal first = std::move(found_.front());
  found_.pop_front();
  return first;
}

void Proposals::look() {
  if (question_.rest) solve(*question_.rest, "rest, solved");
  if (task_.planner.guidance) {
    if (!road_ways_ || !follow_road()) follow_ways();
    return;
  }
  const auto& x = question_.from;
  const double distance = std::hypot(task_.goal.x - x[X], task_.goal.y - x[Y]);
  solve(straight_reference(x, question_.t_from, distance / std::max(x[UX], kStraightSpeed)),
        "straight on, solved");
}

/// Ways along the road, tracked; where none arrives, the best are solved. Whether one arrives.
bool Proposals::follow_road() {
  auto obstacles = question_.obstacles;
  for (auto& o : obstacles) o = o.grown(question_.need.clearance);
  world::RoadWaySearch search;
  search.beyond = question_.beyond;
  search.creep = standing_of(task_.vehicle, true).creep;
  std::vector<std::pair<std::string, Motion>> guesses;
  std::vector<RoadKept> all(kRoadKept.begin(), kRoadKept.end());
  const double lesser = task_.planner.kept_clearance - question_.need.clearance;
  if (lesser < 0) all.push_back({lesser + kLesserSpare, 0.02, 0.95});
  for (const RoadKept& kept : all) {
    search.clearance = kept.clearance;
    search.edge = question_.need.edge + kept.edge;
    search.limits = kept.limits;
    const auto ways = road_ways_->to_goal(question_.from, question_.t_from, obstacles, search, [&] {
      return turns_.spend(world::RoadWays::kAskedEvery);
    });
    int left = question_.ways;
    for (const world::RoadWay& way : ways) {
      if (left-- == 0 || turns_.spend(0)) break;
      if (way.end > question_.arrival - kSooner) continue;
      turns_.wait_for(longest_besides_s_);
      const Timer timer;
      const Motion reference = reference_of(way.way, task_.vehicle);
      const std::string name = fmt::format("way {} along the road", guesses.size() + 1);
      Motion guess = tracked(reference);
      const bool arrives = propose(name, guess, false);
      longest_besides_s_ = std::max(longest_besides_s_, timer.cpu());
      if (arrives) return true;
      while (guess.size() > 2 && guess.end() > way.end + kSameTime) guess.drop_last();
      guesses.emplace_back(name, std::move(guess));
    }
  }
  for (std::size_t k = 0; k < std::min(guesses.size(), kRoadSolves); ++k)
    if (solve(guesses[k].second, guesses[k].first + ", solved")) return true;
  return false;
}

void Proposals::follow_ways() {
  auto obstacles = question_.obstacles;
  for (auto& o : obstacles) o = o.grown(question_.need.clearance);
  auto search = world::way_search(task_.vehicle);
  search.clearance = std::min(kWayClearance, question_.need.clearance);
  search.max_places = question_.places;
  int number = 0;
  ways_.find_ways(
      question_.from, question_.t_from, obstacles, search, question_.ways,
      [&](const world::Way& way) { return follow(way, "way " + std::to_string(++number)); },
      [&] { return turns_.spend(world::WayFinder::kAskedEvery); });
}

/// Whether the way leads to a verified arrival.
bool Proposals::follow(const world::Way& way, const std::string& name) {
  if (way.back().t > question_.arrival - kSooner) return false;
  turns_.wait_for(longest_besides_s_);
  const Timer timer;
  const Motion reference = braked_on(reference_of(way, task_.vehicle), task_.vehicle,
                                     task_.road.get(), question_.beyond);
  Motion guess = tracked(reference);
  const bool arrives = propose(name, guess, false);
  longest_besides_s_ = std::max(longest_besides_s_, timer.cpu());
  const State &end = guess.states.back(), &wanted = reference.states.back();
  if (apart(end, wanted) > kAstray) guess = reference;
  while (guess.size() > 2 && guess.end() > way.back().t + kSameTime) guess.drop_last();
  return solve(guess, name + ", solved") || arrives;
}

/// What the plant makes of a reference, from the question's state to the reference's end.
Motion Proposals::tracked(const Motion& reference) {
  return tracker_.follow(reference, question_.from, question_.t_from, reference.end());
}

/// An answer, tracked, and then on without control; nothing where the plant cannot be driven so.
Motion Proposals::coasting(const Motion& answer) {
  try {
    return tracker_.driven_on(tracker_.released(tracked(answer)), answer.end() + question_.beyond);
  } catch (const vehicle::PlantError&) {
    return {};
  }
}

/// Judges a motion. Whether it is a verified arrival.
bool Proposals::propose(const std::string& name, Motion motion, bool solved) {
  turns_.spend(kMotion);
  Proposal proposal{name, std::move(motion), {}, solved};
  proposal.verdict =
      verifier_.judge(proposal.motion, question_.obstacles, question_.need, question_.looks);
  const bool arrives = (proposal.verdict.certificate.verified || proposal.verdict.unseen) &&
                       proposal.verdict.end == MotionEnd::arrives;
  found_.push_back(std::move(proposal));
  return arrives;
}

/// The obstacles that the OCP keeps off: those that come near the guess, grown by their margins.
ArrivalProblem::Obstacles Proposals::near(const Motion& guess,
                                          const std::vector<double>& extra) const {
  ArrivalProblem::Obstacles result;
  const double margin = question_.need.clearance + task_.planner.arrival_margin;
  const Settings& s = task_.planner;
  const auto vehicle = footprint_.covering_discs(s.cover_excess);
  std::vector<std::vector<Passed>> places;
  for (const auto& disc : vehicle) places.push_back(places_of(guess, disc.ahead));
  for (std::size_t k = 0; k < question_.obstacles.size(); ++k)
    for (const auto& o : stand_ins(s, footprint_, {question_.obstacles[k]})) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t d = 0; d < vehicle.size(); ++d)
        least = std::min(least, least_distance(o, places[d]) - vehicle[d].radius);
      const double close = (extra[k] > 0 || o.moves() ? kFar : kClose) + margin;
      if (least < close)
        result.close.push_back(o.grown(margin + extra[k]));
      else if (least < kFar + margin)
        result.far.push_back(o.grown(margin + extra[k]));
    }
  return result;
}

/// The problem with room for these obstacles, made when it is first wanted and there is time to.
/// While there is none, one with more room will do.
ArrivalProblem* Proposals::problem_for(const ArrivalProblem::Obstacles& obstacles) {
  const auto room = ArrivalProblem::room_for(obstacles);
  const auto found = problems_.find(room);
  if (found != problems_.end()) return &found->second;
  if (turns_.wait_for(longest_making_s_)) {
    const Timer timer;
    ArrivalProblem& made = problems_.try_emplace(room, task_, room).first->second;
    longest_making_s_ = std::max(longest_making_s_, timer.cpu());
    turns_.spend(kMaking);
    return &made;
  }
  for (auto& [other, problem] : problems_)
    if (other.holds(room)) return &problem;
  return nullptr;
}

/// A motion, but for what lies deep within the goal's square at its end.
Motion Proposals::to_the_goal(Motion motion) const {
  const double depth = depth_of(task_.goal);
  const auto deep = [&](std::size_t k) {
    return task_.goal.outside(motion.states[k], motion.t[k], task_.road.get()) < -depth;
  };
  while (motion.size() > 2 && deep(motion.size() - 2)) motion.drop_last();
  return motion;
}

/// The answer of the OCP among obstacles grown by their margins and `extra`, and so far from the
/// road's edges.
std::optional<Motion> Proposals::answer_from(const Motion& guess, const std::vector<double>& extra,
                                             double edge_margin) {
  const auto obstacles = near(guess, extra);
  ArrivalProblem* problem = problem_for(obstacles);
  if (!problem) return std::nullopt;
  nlp::Options options;
  options.floor = task_.planner.arrival_floor;
  options.tol = task_.planner.tol;
  options.max_iterations = task_.planner.arrival_max_iterations;
  options.stop = cancelled;
  options.stop_data = &turns_;
  auto answer = problem->solve(guess, question_.from, obstacles, edge_margin, *solver_, options);
  iterations_ += problem->iterations();
  return answer;
}

/// Solves from a guess, tracks the answer, and where that came too near to an obstacle, solves
/// again with it grown. Whether it comes to a verified arrival.
bool Proposals::solve(const Motion& guess, const std::string& name) {
  std::vector<double> extra(question_.obstacles.size(), 0);
  double edge_margin = question_.need.edge;
  Motion from = to_the_goal(guess);
  for (int round = 0; round < kRounds; ++round) {
    if (from.end() - from.begin() < kShortest) return false;
    auto answer = answer_from(from, extra, edge_margin);
    turns_.wait_for(longest_besides_s_);
    if (!answer || turns_.spend(0)) return false;
    const Timer timer;
    Motion motion = tracked(braked_on(*answer, task_.vehicle, task_.road.get(), question_.beyond));
    bool arrives = propose(name, std::move(motion), true);
    // An answer may end in a bend in which the vehicle may not brake at once.
    if (task_.road && !arrives && verifier_.last().certificate.refused_at > answer->end())
      if (Motion on = coasting(*answer); on.size() > 1)
        arrives = propose(name, std::move(on), true);
    longest_besides_s_ = std::max(longest_besides_s_, timer.cpu());
    if (arrives) return true;
    if (!regrow(extra, edge_margin)) return false;
    from = std::move(*answer);
  }
  return false;
}

/// Whether an obstacle or an edge was too near to the last motion, and is grown.
bool Proposals::regrow(std::vector<double>& extra, double& edge_margin) const {
  const Verdict& verdict = verifier_.last();
  bool regrown = false;
  for (std::size_t k = 0; k < extra.size(); ++k) {
    const double short_of = question_.need.clearance - verdict.nearest[k];
    if (short_of <= 0) continue;
    extra[k] += short_of + kRegrow;
    regrown = true;
  }
  if (const double short_of = question_.need.edge - verdict.nearest_edge; short_of > 0) {
    edge_margin += short_of + kRegrowEdge;
    regrown = true;
  }
  return regrown;
}

}  // namespace slalom::planner
