#pragma once

namespace lamp {

/** The program lamp-pgo. \return 0; 1 if the optimisation failed; 2 for wrong use. */
int pgoApp(int argc, char** argv);

}  // namespace lamp
