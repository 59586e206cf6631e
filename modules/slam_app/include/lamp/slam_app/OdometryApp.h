#pragma once

namespace lamp {

/** The command line of `lamp-odometry`: the robots' front ends alone, without loop closures.
 *  \return the exit code: 0 done, 1 failed, 2 wrong arguments or ini. */
int odometryApp(int argc, char** argv);

}  // namespace lamp
