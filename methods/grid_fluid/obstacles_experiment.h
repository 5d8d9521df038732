// Measures what flows into obstacles: air through their surface, smoke into them and through walls (claim R29).
//
// Units: metres, seconds. Threads: the current oneTBB arena; the same at any number of them. Source: Senger2009, 4.1.3.
#pragma once

#include "methods/contract/experiment.h"

namespace dustbench::grid_fluid::obstacles {

/// `perforated`: a ball without every fourth of its cells. `holedWall`: a wall without four by four of its cells, where
/// the jet meets it.
enum class Obstacle { none, ball, perforatedBall, wall, holedWall };

/// A jet of smoke blows at a ball of 1 m or at a wall of a tenth of a cell, askew across the box, for 1.7 s.
struct ObstacleSettings {
    bool asPublished = false;  ///< the demo as published; else our scheme
    Obstacle obstacle = Obstacle::ball;
    float ballMetresPerSecond = 0;  ///< against the jet
    float jetMetresPerSecond = 3;   ///< a cell in a step
};

struct ObstacleReport {
    /// What flows inwards through the ball's surface, relative to the ball and where it flows inwards: maximum of all
    /// steps, m³/s.
    double inflowM3PerSecond = 0;
    /// The maximum density within the obstacle, relative to the maximum around it: maximum of all steps.
    double smokeInside = 0;
    /// Of all smoke, the share behind the plane of the wall in the end.
    double smokeBehind = 0;
};

[[nodiscard]] ObstacleReport measureObstacle(const ObstacleSettings& settings);

/// The experiment `obstacles`, for our scheme (`_ours`) and the demo as published (`_demo`):
///     inflow_rest_…, inflow_moving_…     into a ball, relative to that through its place where no ball is
///     inflow_perforated_…                into a ball with holes
///     smoke_inside_…                     the maximum of balls and wall
///     behind_wall_…, behind_wall_fast_…  by a jet of a cell and of four cells in a step
///     behind_hole_…, behind_nothing_…    of a wall with a hole; of none
[[nodiscard]] ExperimentInfo describe();

}  // namespace dustbench::grid_fluid::obstacles
