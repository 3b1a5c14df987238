#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "statement.hpp"

// A rocket with several stages, in phases.

namespace slalom::problems {
namespace {

using Vector = std::array<Expr, 3>;
using Numbers = std::array<double, 3>;

template <class A, class B>
auto cross(const A& a, const B& b) {
  return std::array{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                    a[0] * b[1] - a[1] * b[0]};
}
template <class A, class B>
auto dot(const A& a, const B& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The Earth and its air (SI).
constexpr double kMu = 3.986012e14, kRadius = 6378145, kSpin = 7.29211585e-5;
constexpr double kDensity = 1.225, kScaleHeight = 7200, kDrag = 0.5 * 4 * M_PI;
constexpr double kDegree = M_PI / 180;

struct Motor {
  double propellant, mass, thrust, burn;  ///< kg, kg with its casing, N, s

  double flow() const { return propellant / burn; }
  double casing() const { return mass - propellant; }
};
constexpr Motor kSolid{17010, 19290, 628500, 75.2}, kFirst{95550, 104380, 1083100, 261},
    kSecond{16820, 19300, 110094, 700};
constexpr double kPayload = 4164;

/// What burns in a phase, from when to when, and what is dropped after it.
struct Burn {
  double begin, end, thrust, flow, dropped;
};
const std::array<Burn, 4> kBurns = {{{0, 75.2, 6 * kSolid.thrust + kFirst.thrust,
                                      6 * kSolid.flow() + kFirst.flow(), 6 * kSolid.casing()},
                                     {75.2, 150.4, 3 * kSolid.thrust + kFirst.thrust,
                                      3 * kSolid.flow() + kFirst.flow(), 3 * kSolid.casing()},
                                     {150.4, 261, kFirst.thrust, kFirst.flow(), kFirst.casing()},
                                     {261, 961, kSecond.thrust, kSecond.flow(), 0}}};

/// The orbit to reach: towards its perigee, across, and normal to it; parameter and eccentricity.
struct Orbit {
  Numbers p, q, w;
  double parameter = 24361140 * (1 - 0.7308 * 0.7308), eccentricity = 0.7308;

  Orbit() {
    const double i = 28.5 * kDegree, node = 269.8 * kDegree, perigee = 130.5 * kDegree;
    const double cn = std::cos(node), sn = std::sin(node), ci = std::cos(i), si = std::sin(i);
    const double cp = std::cos(perigee), sp = std::sin(perigee);
    p = {cn * cp - sn * sp * ci, sn * cp + cn * sp * ci, sp * si};
    q = {-cn * sp - sn * cp * ci, -sn * sp + cn * cp * ci, cp * si};
    w = cross(p, q);
  }
};

/// States r, v, m at the end are on the orbit: by its angular momentum and eccentricity vector.
void reach(Problem& p, const Orbit& orbit, const Vector& r, const Vector& v) {
  Vector R, V;
  for (int i = 0; i < 3; ++i) {
    R[i] = p.final(r[i]);
    V[i] = p.final(v[i]);
  }
  const auto h = cross(R, V), pull = cross(V, h);
  const Expr distance = sqrt(dot(R, R));
  const double momentum = std::sqrt(kMu * orbit.parameter);
  for (int i = 0; i < 3; ++i)
    p.boundary(std::string("momentum ") + "xyz"[i], h[i] / momentum, Bounds::equal(orbit.w[i]));
  const auto along = [&](const Numbers& axis) {
    return dot(pull, axis) / kMu - dot(R, axis) / distance;
  };
  p.boundary("eccentricity", along(orbit.p), Bounds::equal(orbit.eccentricity));
  p.boundary("perigee", along(orbit.q), Bounds::equal(0));
}

/// Betts 2010, example 6.15 (Benson 2005): a Delta III to a transfer orbit.
Statement delta_three() {
  PhasedProblem all("Delta III");
  std::vector<ocp::Trajectory> guesses;
  const Orbit orbit;
  const double latitude = 28.5 * kDegree;
  const Numbers r0 = {kRadius * std::cos(latitude), 0, kRadius * std::sin(latitude)};
  const Numbers v0 = {0, kSpin * r0[0], 0};
  double mass = kPayload + kSecond.mass + kFirst.mass + 9 * kSolid.mass;
  for (std::size_t k = 0; k < kBurns.size(); ++k) {
    const Burn& burn = kBurns[k];
    const bool first = k == 0, last = k + 1 == kBurns.size();
    const double end = mass - burn.flow * (burn.end - burn.begin);
    Problem p("stage " + std::to_string(k + 1));
    Vector r, v, u;
    for (int i = 0; i < 3; ++i) r[i] = p.state(std::string("r") + "xyz" [i], { -2e7, 2e7 });
    for (int i = 0; i < 3; ++i) v[i] = p.state(std::string("v") + "xyz" [i], { -1e4, 1e4 });
    const Expr m = p.state("m", {last ? kPayload : end, mass});
    for (int i = 0; i < 3; ++i) u[i] = p.control(std::string("u") + "xyz" [i], { -1, 1 });
    const Expr distance = sqrt(dot(r, r));
    const Vector air = {v[0] + kSpin * r[1], v[1] - kSpin * r[0], v[2]};
    const Expr drag = kDensity * exp((kRadius - distance) / kScaleHeight) * kDrag / 2 *
                      sqrt(dot(air, air) + 1e-6);
    for (int i = 0; i < 3; ++i) {
      p.dynamics(r[i], v[i]);
      p.dynamics(v[i], (burn.thrust * u[i] - drag * air[i]) / m -
                           kMu / (distance * distance * distance) * r[i]);
      if (first) starts(p, r[i], r0[i]);
      if (first) starts(p, v[i], v0[i]);
    }
    p.dynamics(m, -burn.flow);
    if (first) starts(p, m, mass);
    p.path("direction", dot(u, u), Bounds::equal(1));
    p.path("ground", distance / kRadius, Bounds::at_least(1));
    p.initial_time(Bounds::equal(burn.begin), burn.begin);
    if (last)
      p.final_time({burn.begin, burn.end}, burn.end);
    else
      horizon(p, burn.end);
    if (last) reach(p, orbit, r, v);
    if (last) p.mayer("mass", -p.final(m));
    all.add(p);
    // Where it starts, and for the last stage the orbit's perigee.
    Numbers place = r0, speed = v0;
    const double at = orbit.parameter / (1 + orbit.eccentricity);
    for (int i = 0; last && i < 3; ++i) {
      place[i] = orbit.p[i] * at;
      speed[i] = orbit.q[i] * std::sqrt(kMu / orbit.parameter) * (1 + orbit.eccentricity);
    }
    const auto state = [&](double of_mass) {
      return std::vector<double>{place[0], place[1], place[2], speed[0],
                                 speed[1], speed[2], of_mass};
    };
    const std::vector<double> thrust =
        last ? std::vector<double>{0, 1, 0} : std::vector<double>{1, 0, 0};
    guesses.push_back(line(burn.begin, burn.end, state(mass), state(end), thrust, thrust));
    mass = end - burn.dropped;
  }
  for (std::size_t k = 0; k + 1 < kBurns.size(); ++k)
    all.connect(k, k + 1, {.without = {}, .jumps = {{"m", -kBurns[k].dropped}}});
  return {all, guesses};
}

}  // namespace

Entries ascent() {
  return {
      {.name = "delta-iii",
       .title = "A Delta III with strap-on motors to a transfer orbit",
       .source = "Betts 2010, example 6.15; Benson 2005",
       .hard = "four phases of unlike masses, the end an orbit; masses begin at their bounds",
       .tags = {Tag::phases, Tag::free_final_time},
       .maximised = true,
       .published = Published{"7529.712287", "Hall, YAPSS, delta_iii_ascent"},
       .intervals = 10,
       .state = delta_three},
  };
}

}  // namespace slalom::problems
