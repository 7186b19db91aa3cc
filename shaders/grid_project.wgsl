#import shared/grid_cells
#import shared/outlines

// Projects the surviving cells of a grid: the outlines of one chunk.
