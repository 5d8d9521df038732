// Measures leaks into obstacles: air through their surface, smoke into them and through walls (claim R29).
//
// Units: metres, seconds. Threads: the current oneTBB arena; results do not depend on their number.
// Source: Senger2009, 4.1.3.
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::grid_fluid::obstacles {

/// `perforated`: a ball that lacks every fourth cell. `holedWall`: a wall with a hole of four by four cells where the
/// jet meets it.
enum class Obstacle { none, ball, perforatedBall, wall, holedWall };

/// A jet of smoke blows for 1.7 s at a ball of 1 m, or at a wall a tenth of a cell thick that crosses the box
/// obliquely.
struct ObstacleSettings {
    bool asPublished = false;  ///< the demo as published; otherwise our scheme
    Obstacle obstacle = Obstacle::ball;
    float ballMetresPerSecond = 0;  ///< against the jet
    float jetMetresPerSecond = 3;   ///< one cell per step
};

struct ObstacleReport {
    /// Inflow through the ball's surface, relative to the ball, over the faces with inward flow: maximum over all
    /// steps, m³/s.
    double inflowM3PerSecond = 0;
    /// The maximum density within the obstacle, relative to the maximum around it: maximum over all steps.
    double smokeInside = 0;
    /// The share of all smoke that is behind the plane of the wall at the end.
    double smokeBehind = 0;
};

[[nodiscard]] ObstacleReport measureObstacle(const ObstacleSettings& settings);

/// The experiment `obstacles`, for our scheme (`_ours`) and the demo as published (`_demo`):
///     inflow_rest_…, inflow_moving_…     into a ball, relative to the flow through the same surface without a ball
///     inflow_perforated_…                into a ball with holes
///     smoke_inside_…                     the maximum over balls and wall
///     behind_wall_…, behind_wall_fast_…  with a jet of one cell and of four cells per step
///     behind_hole_…, behind_nothing_…    with a hole in the wall; without a wall
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::obstacles
