#include <cmath>

#include "statement.hpp"

// Problems of medicine and biochemistry.

namespace slalom::problems {
namespace {

Statement tuberculosis() {
  Problem p("two-strain tuberculosis");
  const double beta1 = 13, beta2 = 13, mu = 0.0143, k1 = 0.5, k2 = 1, r1 = 2, r2 = 1;
  const double share = 0.4, q = 0.1, N = 30000, beta3 = 0.029;
  const Expr S = p.state("S"), T = p.state("T"), L1 = p.state("L1"), L2 = p.state("L2");
  const Expr I1 = p.state("I1"), I2 = p.state("I2");
  const Expr u1 = p.control("u1", {0.05, 0.95}), u2 = p.control("u2", {0.05, 0.95});
  const Expr first = I1 / N, second = beta3 * I2 / N;
  p.dynamics(S, mu * N - beta1 * S * first - S * second - mu * S);
  p.dynamics(T, u1 * r1 * L1 - mu * T + (1 - (1 - u2) * (share + q)) * r2 * I1 - beta2 * T * first -
                    T * second);
  p.dynamics(L1, beta1 * S * first - (mu + k1) * L1 - u1 * r1 * L1 + (1 - u2) * share * r2 * I1 +
                     beta2 * T * first - L1 * second);
  p.dynamics(L2, (1 - u2) * q * r2 * I1 - (mu + k2) * L2 + (S + L1 + T) * second);
  p.dynamics(I1, k1 * L1 - (mu + r2) * I1);
  p.dynamics(I2, k2 * L2 - mu * I2);
  p.lagrange("burden", L2 + I2 + 25 * square(u1) + 250 * square(u2));
  starts(p, S, 19000);
  starts(p, T, 250);
  starts(p, L1, 9000);
  starts(p, L2, 500);
  starts(p, I1, 1000);
  starts(p, I2, 250);
  horizon(p, 5);
  return {p,
          {line(0, 5, {19000, 250, 9000, 500, 1000, 250}, {19000, 250, 9000, 500, 1000, 250},
                {0.5, 0.5}, {0.5, 0.5})}};
}

Statement tumour() {
  Problem p("tumour anti-angiogenesis");
  const double xi = 0.084, b = 5.85, mu = 0.02, d = 0.00873, G = 0.15, dose = 75, total = 15;
  const double most = std::pow((b - mu) / d, 1.5);
  const Expr v = p.state("p", {0.1, most}), q = p.state("q", {0.1, most});
  const Expr y = p.state("y", {0, total}), u = p.control("u", {0, dose});
  p.dynamics(v, -xi * v * log(v / q));
  p.dynamics(q, q * (b - mu - d * pow(v, 2.0 / 3) - G * u));
  p.dynamics(y, u);
  starts(p, v, most / 2);
  starts(p, q, most / 4);
  starts(p, y, 0);
  p.final_time({0.1, 5}, 1);
  p.mayer("tumour", p.final(v));
  return {p, {line(0, 1, {most / 2, most / 4, 0}, {most / 2, most / 4, total}, {total}, {total})}};
}

}  // namespace

Entries biology() {
  return {
      {.name = "tuberculosis",
       .title = "Treatment of two strains of tuberculosis",
       .source = "Jung, Lenhart & Feng, Discrete Contin. Dyn. Syst. B 2(4), 2002; Betts 2010, "
                 "section 6.16",
       .hard = "bounds of the controls hold, let go and hold again",
       .published = Published{"5152.07310", "Betts, A Collection of Optimal Control Test Problems"},
       .state = tuberculosis},
      {.name = "tumour",
       .title = "Least tumour by a given amount of a drug",
       .source =
           "Ledzewicz & Schaettler, SIAM J. Control Optim. 46(3), 2007; Betts 2010, section 6.17",
       .hard = "bang, then none, at a kink of the tumour's growth",
       .tags = {Tag::bang_bang, Tag::free_final_time},
       .published = Published{"7571.6712", "Betts, A Collection of Optimal Control Test Problems"},
       .state = tumour},
  };
}

}  // namespace slalom::problems
