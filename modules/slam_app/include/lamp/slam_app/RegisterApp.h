#pragma once

namespace lamp {

/** The command line of `lamp-register`: registers two clouds as lamp-slam would, and says what came
 * of it and why. \return the exit code: 0 also if the registration was refused, 1 failed, 2 wrong
 * arguments or ini. */
int registerApp(int argc, char** argv);

}  // namespace lamp
