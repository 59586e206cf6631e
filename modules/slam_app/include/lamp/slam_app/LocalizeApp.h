#pragma once

namespace lamp {

/** The command line of `lamp-localize`: the robots' trajectories in a surveyed map.
 *  \return the exit code: 0 done, 1 failed, 2 wrong arguments or ini. */
int localizeApp(int argc, char** argv);

}  // namespace lamp
