#pragma once

namespace lamp::evaluation {

/** The program lamp-eval. \return 0; 1 if the evaluation failed; 2 for wrong use. */
int evalApp(int argc, char** argv);

}  // namespace lamp::evaluation
