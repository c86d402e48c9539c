/* Runs a whole pipeline in one process: the program glint. */
#pragma once

/* The main of glint. */
int pipeline_process_main(int count, char **words);
