#pragma once

namespace lamp::simulation {

/** The program `lamp-sim`. \return its exit code: 0, 1 if it failed, 2 if it was used wrongly. */
int simApp(int argc, char** argv);

}  // namespace lamp::simulation
