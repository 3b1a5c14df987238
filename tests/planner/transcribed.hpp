#pragma once

#include <memory>
#include <vector>

#include "../../src/planner/trajectory_problem.hpp"
#include "planner/scenes.hpp"
#include "slalom/ocp/transcription.hpp"

namespace slalom::planner {

/// One of the forms of a scene's OCP as a solver sees it.
class TranscribedScene {
 public:
  explicit TranscribedScene(Scene s, bool in_range = false)
      : scene(std::move(s)), problem_(scene, scene.obstacles, in_range) {
    problem_.update(scene.first);
    nlp = std::make_unique<ocp::Transcription>(
        problem_.problem(), ocp::Mesh::uniform(scene.planner.N), ocp::trapezoidal());
  }

  void update(const Request& request) {
    problem_.update(request);
    nlp->update(problem_.problem());
  }
  /// Straight on over 40 m in 3 s, slacks inside their rows.
  nlp::Start straight_on(const Request& request) const {
    const State& X0p = request.X0p;
    State end = X0p;
    end[vehicle::X] += 40 * std::cos(X0p[vehicle::PSI]);
    end[vehicle::Y] += 40 * std::sin(X0p[vehicle::PSI]);
    return {nlp->point({0,
                        3,
                        {0, 1},
                        {{X0p.begin(), X0p.end()}, {end.begin(), end.end()}},
                        {{0, 0}, {0, 0}},
                        {},
                        std::vector<double>(8, 0.004)}),
            {},
            {},
            {}};
  }

  const Scene scene;
  std::unique_ptr<ocp::Transcription> nlp;

 private:
  TrajectoryProblem problem_;
};

}  // namespace slalom::planner
