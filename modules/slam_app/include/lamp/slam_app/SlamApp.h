#pragma once

namespace lamp {

/** The command line of `lamp-slam`: parses, builds, runs.
 *  \return the exit code: 0 done, 1 failed, 2 wrong arguments or ini. */
int slamApp(int argc, char** argv);

}  // namespace lamp
