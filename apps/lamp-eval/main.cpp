#include "lamp/evaluation/EvalApp.h"

int main(int argc, char** argv) { return lamp::evalApp(argc, argv); }
