#import shared/mesh_cells
#import shared/outlines

// Projects the surviving cells of a mesh: the outlines of one chunk.
