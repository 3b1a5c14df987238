#include <vector>

#include "fit.hpp"

// Constants of models fitted to measurements. The data are those of the sources' tables.

namespace slalom::problems {
namespace {

using Exprs = std::vector<Expr>;

Statement gas_oil() {
  return fitted(
      {.name = "gas oil",
       .states = {"y1", "y2"},
       .constants = {"theta1", "theta2", "theta3"},
       .guess = {10, 10, 1},
       .begin = {1, 0},
       .times = {0,   0.025, 0.05, 0.075, 0.1, 0.125, 0.15, 0.175, 0.2,  0.225, 0.25,
                 0.3, 0.35,  0.4,  0.45,  0.5, 0.55,  0.65, 0.75,  0.85, 0.95},
       .data = {{1, 0},           {0.8105, 0.2},    {0.6208, 0.2886}, {0.5258, 0.301},
                {0.4345, 0.3215}, {0.3903, 0.3123}, {0.3342, 0.2716}, {0.3034, 0.2551},
                {0.2735, 0.2258}, {0.2405, 0.1959}, {0.2283, 0.1789}, {0.2071, 0.1457},
                {0.1669, 0.1198}, {0.153, 0.0909},  {0.1339, 0.0719}, {0.1265, 0.0561},
                {0.12, 0.046},    {0.099, 0.028},   {0.087, 0.019},   {0.077, 0.014},
                {0.069, 0.01}},
       .rates = [](const Exprs& y, const Exprs& theta, const Expr&) -> Exprs {
         return {-(theta[0] + theta[2]) * square(y[0]), theta[0] * square(y[0]) - theta[1] * y[1]};
       }});
}

Statement methanol() {
  return fitted({.name = "methanol",
                 .states = {"y1", "y2", "y3"},
                 .constants = {"theta1", "theta2", "theta3", "theta4", "theta5"},
                 .guess = {1, 1, 1, 1, 1},
                 .begin = {1, 0, 0},
                 .times = {0, 0.05, 0.065, 0.08, 0.123, 0.233, 0.273, 0.354, 0.397, 0.418, 0.502,
                           0.553, 0.681, 0.75, 0.916, 0.937, 1.122},
                 .data = {{1, 0, 0},
                          {0.7085, 0.1621, 0.0811},
                          {0.5971, 0.1855, 0.0965},
                          {0.5537, 0.1989, 0.1198},
                          {0.3684, 0.2845, 0.1535},
                          {0.1712, 0.3491, 0.2097},
                          {0.1198, 0.3098, 0.2628},
                          {0.0747, 0.3576, 0.2467},
                          {0.0529, 0.3347, 0.2884},
                          {0.0415, 0.3388, 0.2757},
                          {0.0261, 0.3557, 0.3167},
                          {0.0208, 0.3483, 0.2954},
                          {0.0085, 0.3836, 0.295},
                          {0.0053, 0.3611, 0.2937},
                          {0.0019, 0.3609, 0.2831},
                          {0.0018, 0.3485, 0.2846},
                          {0.0006, 0.3698, 0.2899}},
                 .rates = [](const Exprs& y, const Exprs& k, const Expr&) -> Exprs {
                   const Expr share = k[0] * y[0] / ((k[1] + k[4]) * y[0] + y[1]);
                   return {-(2 * k[1] + k[2] + k[3]) * y[0] + share * y[1],
                           share * (k[1] * y[0] - y[1]) + k[2] * y[0],
                           share * (y[1] + k[4] * y[0]) + k[3] * y[0]};
                 }});
}

Statement alpha_pinene() {
  return fitted({.name = "alpha-pinene",
                 .states = {"y1", "y2", "y3", "y4", "y5"},
                 .constants = {"theta1", "theta2", "theta3", "theta4", "theta5"},
                 .guess = {1e-4, 1e-4, 1e-4, 1e-4, 1e-4},
                 .begin = {100, 0, 0, 0, 0},
                 .times = {1230, 3060, 4920, 7800, 10680, 15030, 22620, 36420},
                 .data = {{88.35, 7.3, 2.3, 0.4, 1.75},
                          {76.4, 15.6, 4.5, 0.7, 2.8},
                          {65.1, 23.1, 5.3, 1.1, 5.8},
                          {50.4, 32.9, 6, 1.5, 9.3},
                          {37.5, 42.7, 6, 1.9, 12},
                          {25.9, 49.1, 5.9, 2.2, 17},
                          {14, 57.4, 5.1, 2.6, 21},
                          {4.5, 63.1, 3.8, 2.9, 25.7}},
                 .rates = [](const Exprs& y, const Exprs& k, const Expr&) -> Exprs {
                   return {-(k[0] + k[1]) * y[0], k[0] * y[0],
                           k[1] * y[0] - (k[2] + k[3]) * y[2] + k[4] * y[4], k[2] * y[2],
                           k[3] * y[2] - k[4] * y[4]};
                 }});
}

Statement marine_population() {
  std::vector<double> times;
  for (int k = 0; k <= 20; ++k) times.push_back(k / 2.0);
  return fitted({.name = "marine population",
                 .states = {"y1", "y2", "y3", "y4", "y5", "y6", "y7", "y8"},
                 .constants = {"g1", "g2", "g3", "g4", "g5", "g6", "g7", "m1", "m2", "m3", "m4",
                               "m5", "m6", "m7", "m8"},
                 .guess = std::vector<double>(15, 0.5),
                 .begin = {},
                 .times = times,
                 .data = {{20000, 17000, 10000, 15000, 12000, 9000, 7000, 3000},
                          {12445, 15411, 13040, 13338, 13484, 8426, 6615, 4022},
                          {7705, 13074, 14623, 11976, 12453, 9272, 6891, 5020},
                          {4664, 8579, 12434, 12603, 11738, 9710, 6821, 5722},
                          {2977, 7053, 11219, 11340, 13665, 8534, 6242, 5695},
                          {1769, 5054, 10065, 11232, 12112, 9600, 6647, 7034},
                          {943, 3907, 9473, 10334, 11115, 8826, 6842, 7348},
                          {581, 2624, 7421, 10297, 12427, 8747, 7199, 7684},
                          {355, 1744, 5369, 7748, 10057, 8698, 6542, 7410},
                          {223, 1272, 4713, 6869, 9564, 8766, 6810, 6961},
                          {137, 821, 3451, 6050, 8671, 8291, 6827, 7525},
                          {87, 577, 2649, 5454, 8430, 7411, 6423, 8388},
                          {49, 337, 2058, 4115, 7435, 7627, 6268, 7189},
                          {32, 228, 1440, 3790, 6474, 6658, 5859, 7467},
                          {17, 168, 1178, 3087, 6524, 5880, 5562, 7144},
                          {11, 99, 919, 2596, 5360, 5762, 4480, 7256},
                          {7, 65, 647, 1873, 4556, 5058, 4944, 7538},
                          {4, 44, 509, 1571, 4009, 4527, 4233, 6649},
                          {2, 27, 345, 1227, 3677, 4229, 3805, 6378},
                          {1, 20, 231, 934, 3197, 3695, 3159, 6454},
                          {1, 12, 198, 707, 2562, 3163, 3232, 5566}},
                 .rates = [](const Exprs& y, const Exprs& k, const Expr&) -> Exprs {
                   Exprs rates;
                   for (std::size_t s = 0; s < 8; ++s) {
                     Expr rate = -k[7 + s] * y[s];
                     if (s < 7) rate -= k[s] * y[s];
                     if (s > 0) rate += k[s - 1] * y[s - 1];
                     rates.push_back(rate);
                   }
                   return rates;
                 }});
}

Statement predator_prey() {
  return fitted({.name = "predator and prey",
                 .states = {"x1", "x2"},
                 .constants = {"p1", "p2", "p3", "p4"},
                 .guess = {1, 1, 1, 1},
                 .begin = {0.4, 1},
                 .times = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10},
                 .data = {{0.58462429, 1.653802752},
                          {1.480323792, 1.898433328},
                          {1.941197515, 0.791087389},
                          {1.266090393, 0.402385741},
                          {0.68499583, 0.435968041},
                          {0.435253441, 0.725707829},
                          {0.404814065, 1.244405746},
                          {0.822427034, 2.052562952},
                          {1.771604896, 1.426515341},
                          {1.754832745, 0.548344791}},
                 .rates = [](const Exprs& x, const Exprs& p, const Expr&) -> Exprs {
                   return {-p[0] * x[0] + p[1] * x[0] * x[1], p[2] * x[1] - p[3] * x[0] * x[1]};
                 }});
}

}  // namespace

Entries parameter_estimation() {
  const std::vector<Tag> tags = {Tag::phases, Tag::parameter_estimation};
  return {
      {.name = "gas-oil",
       .title = "Catalytic cracking of gas oil",
       .source = "Tjoa & Biegler, Ind. Eng. Chem. Res. 30, 1991; COPS 3.0, problem 12",
       .hard = "three correlated rates",
       .tags = tags,
       .published = Published{"5.23659e-3", "COPS 3.0"},
       .intervals = 4,
       .state = gas_oil},
      {.name = "methanol",
       .title = "Methanol to hydrocarbons",
       .source = "Maria 1989; COPS 3.0, problem 13",
       .hard = "two of five rates are 0 at the best fit",
       .tags = tags,
       .published = Published{"9.02229e-3", "COPS 3.0"},
       .converged = 9.02251e-3,
       .remark = "the print is of a mesh that the measurements do not stand on; here HS by 1e-9 "
                 "and LGR end "
                 "at 9.02251e-3 and 9.02247e-3",
       .intervals = 4,
       .state = methanol},
      {.name = "alpha-pinene",
       .title = "Isomerisation of alpha-pinene",
       .source = "Box et al. 1973; COPS 3.0, problem 5",
       .hard = "constants of size 1e-5 and times of 1e4",
       .tags = tags,
       .published = Published{"19.8721", "COPS 3.0"},
       .intervals = 6,
       .state = alpha_pinene},
      {.name = "marine-population",
       .title = "Growth and mortality of eight stages of a marine species",
       .source = "Rothschild et al. 1997; COPS 3.0, problem 6",
       .hard = "15 constants and 8 unknown initial states",
       .tags = tags,
       .published = Published{"1.97462e7", "COPS 3.0, 100 intervals"},
       .converged = 1.974661e7,
       .remark =
           "the print is of the midpoint rule; refined, HS and LGR end at 19746604 and 19746607",
       .intervals = 4,
       .state = marine_population},
      {.name = "predator-prey",
       .title = "A predator and its prey",
       .source = "Floudas et al. 1999; PSOPT's example",
       .hard = "a periodic solution: fits of other periods are stationary too",
       .tags = {Tag::phases, Tag::parameter_estimation, Tag::local_optima},
       .published = Published{"2.753366e-2", "PSOPT, all examples 2026, predator"},
       .converged = 2.753638e-2,
       .remark = "the print is of 20 nodes over 10 measurements; HS and LGR by 1e-8 end at "
                 "2.7536369e-2 and "
                 "2.7536380e-2",
       .refinement = 1e-8,
       .intervals = 6,
       .state = predator_prey},
  };
}

}  // namespace slalom::problems
